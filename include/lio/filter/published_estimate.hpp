// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Turns the estimate into what is published: in world, which is level, and in map, which never
// jumps.
//
// The filter keeps correcting the tilt of T_world_imu while it separates tilt from accelerometer
// bias: by tenths of a degree, with a consumer IMU by a degree, which a hundred metres from the
// origin is metres of height. The map's frame is the filter's world at the start and is never
// corrected: a path in it keeps its shape, but its tilt is the one known at the start.
// docs/filter.md says which to take for which purpose.
#pragma once

#include "lio/filter/nav_state.hpp"

namespace lio {

struct WorldEstimate {
  Pose T_world_imu;
  Vector3 v_world_imu = Vector3::Zero();  // m/s
  NavCov cov = NavCov::Zero();            // as in nav_state.hpp, 12x12
};

// Returns the filter's own world pose and covariance.
WorldEstimate InWorld(const Estimate& estimate);
// Returns the map's pose as if the map's frame were world. `cov` is the mean square error of that
// use: the filter's covariance plus the square of the known difference between the two poses.
WorldEstimate WithMapAsWorld(const Estimate& estimate);

struct MapVelocity {
  Vector3 v_map_imu = Vector3::Zero();  // m/s
  Matrix3 cov = Matrix3::Zero();
};
// The velocity in map and its covariance, where M = T_map_imu, T = T_world_imu (rotations R_M, R_T)
// and u = R_T^-1 v, the velocity in imu:
//   v_map = R_M u,   dv_map = R_M (R_T^-1 dv + [u]x (dtheta - mu_rotation)).
MapVelocity VelocityInMap(const Estimate& estimate);

}  // namespace lio
