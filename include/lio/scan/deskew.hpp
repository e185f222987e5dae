// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Moves every point of a sweep to where it would be seen at one instant of reference, by the motion
// of the sensor during the sweep.
//
// Inputs: points in the lidar frame, each at its own instant; poses of imu in any one frame that
// does not move during the sweep, stamps increasing; the lidar's place on the imu. All borrowed for
// the call. Points before the first or after the last pose take that pose.
// Output: same count and order, in the imu frame at `reference`.
// Model: between poses rotation is geodesic and translation linear; the poses are sampled on a grid
// of about 1 ms, between which transforms are blended linearly: 4 mm at 60 m and 1 rad/s would need
// 30 ms, here it is below 0.01 mm.
// Cost: linear, no allocation but the result; safe from several threads.
#pragma once

#include <vector>

#include "lio/scan/reduced_scan.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

// When the sweep lasted, and the instant its points are moved to.
struct SweepTimes {
  Timestamp start;  // of the points' offsets
  Timestamp end;
  Timestamp reference;
};

std::vector<Eigen::Vector3f> Deskew(const std::vector<ScanPoint>& points_lidar,
                                    const SweepTimes& times, const StampedPoses& T_any_imu,
                                    const Pose& T_imu_lidar);

}  // namespace lio
