// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds directions that surfaces leave degenerate (along an open road) by the vertical structures
// in the bird's-eye views of earlier scans: correlative alignment (Olson, ICRA 2009) gives a
// position with its covariance, and a linear update blends it with the match.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/registration/scan_matcher.hpp"
#include "lio/relocalization/shift_search.hpp"

namespace lio {

class BirdsEyeHold {
 public:
  // Corrects pose and covariance of a usable match with degenerate directions, and remembers the
  // scan's view where it is some way from the last one. `points_imu` are deskewed, at the pose's
  // instant; `R_level_map` turns up in the map to z; `prior_cov` is that of the pose which matching
  // began with, right error.
  void Apply(std::span<const Eigen::Vector3f> points_imu, const Quaternion& R_level_map,
             const Matrix6& prior_cov, MatchResult& match);

 private:
  std::vector<PlacedView> views_;  // from the last scans, some way apart, in level axes
};

}  // namespace lio
