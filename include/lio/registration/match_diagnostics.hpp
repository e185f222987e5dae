// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Questions about a match that tests and studies ask; the estimator never does. Every matcher of
// this folder answers them: dynamic_cast<const MatchDiagnostics&>(matcher).
#pragma once

#include "lio/base/pose.hpp"

namespace lio {

struct MatchInput;

class MatchDiagnostics {
 public:
  virtual ~MatchDiagnostics() = default;

  // Returns the cost at a pose, with the correspondences and weights of the last Match(), which had
  // this input. Its second derivative at the solution is MatchResult::information.
  [[nodiscard]] virtual double FixedCorrespondenceCost(const MatchInput& input,
                                                       const Pose& T_map_imu) const = 0;
};

}  // namespace lio
