// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Poses that scan matching gives a start, and what they show of the motion between them.
#pragma once

#include "lio/base/pose.hpp"
#include "lio/base/time.hpp"

namespace lio {

// Holds a pose from scan matching, in any one frame that does not move.
struct MatchedPose {
  Timestamp stamp;
  Pose T_any_imu;
  Matrix6 cov = Matrix6::Zero();  // right error [m; rad], by scan matching
};

// Holds the size of a motion between two matched poses, without what may be their errors: zero
// where that is below RestAtStart::min_sigmas of its own standard deviations, as along a direction
// that the scans leave open.
struct ShownMotion {
  double shift_m = 0.0;
  double turn_rad = 0.0;
  double turn_std_rad = 0.0;  // about the axis that the scans hold least
};
[[nodiscard]] ShownMotion ShownBetween(const MatchedPose& then, const MatchedPose& now);

}  // namespace lio
