// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs the loop of every matcher: step by step from the guess, with a correspondence radius that
// shrinks, until the radius is zero and a step is small.
#pragma once

#include <optional>

#include "lio/registration/scan_matcher.hpp"

namespace lio {

struct StopRule {
  int max_steps = 1;
  double small_step_m = 0.0;  // a step smaller than both of these ends the loop
  double small_step_rad = 0.0;

  [[nodiscard]] bool IsSmall(const Vector6& step) const {
    return step.head<3>().norm() < small_step_m && step.tail<3>().norm() < small_step_rad;
  }
};

// Moves `pose` by `step_at(pose, radius)`, a right increment; step_at returns nothing where too
// little of the scan is matched, which ends the loop. `radius` has IsExhausted() and Shrink().
// Fills the result's iterations and status. Returns false where a step was no number: the result is
// complete then.
template <class Radius, class StepAt>
[[nodiscard]] bool StepUntilStill(const StopRule& rule, Radius radius, const StepAt& step_at,
                                  Pose& pose, MatchResult& result) {
  result.status = MatchStatus::kMaxIterations;
  while (result.iterations < rule.max_steps) {
    ++result.iterations;
    const std::optional<Vector6> step = step_at(pose, radius);
    if (!step) break;
    if (!step->allFinite()) {
      result.status = MatchStatus::kDiverged;
      return false;
    }
    pose = pose * ExpSe3(*step);
    if (radius.IsExhausted() && rule.IsSmall(*step)) {
      result.status = MatchStatus::kConverged;
      break;
    }
    radius.Shrink();
  }
  return true;
}

}  // namespace lio
