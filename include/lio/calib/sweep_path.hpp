// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The lidar's path through sweeps whose poses are known, for deskewing in a second pass of scan
// matching. Poses are T_map_lidar, in metres, by the lidar's clock.
//
// Rotation is the gyro's, integrated from the nearest known pose; translation is the natural cubic
// spline through the known positions. Deskewing by constant velocity instead leaves millimetres of
// skew when a person walks, always in the same phase of the step, and with it tenths of a degree of
// error in the rotation between lidar and IMU (docs/calibration.md).
#pragma once

#include <span>
#include <vector>

#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

class SweepPath {
 public:
  // `known` has at least two poses of the lidar at the sweeps' middles. `rates_lidar` are the
  // gyro's rates in the lidar's axes and by its clock; their forces are not used. Throws
  // std::invalid_argument with fewer poses or without rates.
  SweepPath(StampedPoses known, std::vector<ImuSample> rates_lidar);

  Pose At(Timestamp stamp) const;
  // Returns the poses at both stamps and at every rate between them.
  StampedPoses Between(Timestamp from, Timestamp to) const;

 private:
  std::size_t SegmentOf(Timestamp stamp) const;
  Vector3 PositionAt(Timestamp stamp) const;

  StampedPoses known_;
  std::vector<Vector3> velocities_;  // m/s, at the known poses
  std::vector<ImuSample> rates_;
};

}  // namespace lio
