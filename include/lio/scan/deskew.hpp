// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Moves every point of a sweep to where it would be seen at one reference instant, by the motion of
// the sensor during the sweep.
//
// Inputs: points in the lidar frame, each at its own instant; poses of imu in any one frame that
// does not move during the sweep, stamps increasing; the extrinsic T_imu_lidar. All are borrowed
// for the call. Points before the first or after the last pose take that pose. Output: same count
// and order, in the imu frame at `reference`, metres. Model: between poses rotation is geodesic and
// translation linear; the poses are sampled on a grid of about 1 ms (DeskewParameters), between
// which transforms are blended linearly: the error at 60 m and 1 rad/s is below 0.01 mm. Failure:
// throws std::invalid_argument without poses. The cost is linear, with no allocation but the
// result; it is safe from several threads.
#pragma once

#include <vector>

#include "lio/scan/reduced_scan.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

// Begin and end of the sweep, and the instant its points are moved to.
struct SweepTimes {
  Timestamp start;  // instant of t_offset_ns = 0
  Timestamp end;
  Timestamp reference;
};

std::vector<Eigen::Vector3f> Deskew(const std::vector<ScanPoint>& points_lidar,
                                    const SweepTimes& times, const StampedPoses& T_any_imu,
                                    const Pose& T_imu_lidar);

}  // namespace lio
