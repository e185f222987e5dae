// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tells how unsure the path is where the extrinsic was found on the way, which is never exact.
// Matching sees the body B X in place of B if T_imu_lidar has the error X = Exp([t; theta]), so
// that since the start B_s the path is
//   B_s X^-1 B_s^-1 B X,   whose position is off by   (R - R_s) t - (R_s theta) x (p - p_s).
// The part of theta about the vertical turns the way as a whole; gravity and the map that grows
// level (docs/filter.md) take care of the other two. The error is constant, so it stands beside the
// filter, which would average it out.
#pragma once

#include "lio/filter/published_estimate.hpp"
#include "lio/verdict/rig_findings.hpp"

namespace lio {

// Adds what the errors make of an estimate in a frame that is level and began at its origin with a
// yaw of zero.
void AddExtrinsicDoubt(const ExtrinsicStd& std, WorldEstimate& estimate);
// Returns the same as the covariance of the right error of T_map_imu, [translation; rotation].
[[nodiscard]] Matrix6 ExtrinsicDoubtInMap(const ExtrinsicStd& std, const Pose& T_map_imu);

}  // namespace lio
