// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Motion of the lidar through and between sweeps whose poses are known already: what a second pass
// of scan matching deskews along.
//
// Turns are those of a gyro, from the nearest known pose on; translation is a cubic spline, twice
// differentiable, through the known positions. A guess of constant velocity leaves millimetres of
// skew when somebody walks, always in the same phase of the step, and so tenths of a degree in the
// rotation between lidar and IMU; this does not.
#pragma once

#include <span>
#include <vector>

#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

class SweepPath {
 public:
  // `known`: poses of the lidar at the sweeps' middles, two at least. `rates_lidar`: in the lidar's
  // axes, by its clock. Throws std::invalid_argument with less.
  SweepPath(StampedPoses known, std::vector<ImuSample> rates_lidar);

  Pose At(Timestamp stamp) const;
  // At both stamps and at every rate between them.
  StampedPoses Between(Timestamp from, Timestamp to) const;

 private:
  std::size_t SegmentOf(Timestamp stamp) const;
  Vector3 PositionAt(Timestamp stamp) const;

  StampedPoses known_;
  std::vector<Vector3> velocities_;  // m/s, at the known poses
  std::vector<ImuSample> rates_;
};

}  // namespace lio
