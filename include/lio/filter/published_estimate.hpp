// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The estimate as it is published: in world, which is level, and in map, which is steady.
//
// The filter's T_world_imu is the best guess of where gravity points, and keeps changing its mind
// while tilt and accelerometer bias are told apart: by tenths of a degree, with a consumer IMU by a
// degree, which at a hundred metres from the origin is metres of height. The map begins as the
// filter's world and stays where it is: the path in it is never bent after the fact, and its tilt
// is what the start knew. docs/filter.md has what each is good for.
#pragma once

#include "lio/filter/nav_state.hpp"

namespace lio {

struct WorldEstimate {
  Pose T_world_imu;
  Vector3 v_world_imu = Vector3::Zero();  // m/s
  NavCov cov = NavCov::Zero();
};

// The filter's own.
WorldEstimate InWorld(const Estimate& estimate);
// With the map taken for the world. `cov` is the mean square error of a reader who does so: the
// filter's plus the square of the known step between the two.
WorldEstimate WithMapAsWorld(const Estimate& estimate);

struct MapVelocity {
  Vector3 v_map_imu = Vector3::Zero();  // m/s
  Matrix3 cov = Matrix3::Zero();
};
// By M = T_map_imu, T = T_world_imu (rotations R_M, R_T) and u = R_T^-1 v, the velocity in imu:
//   v_map = R_M u,   dv_map = R_M (R_T^-1 dv + [u]x (dtheta - mu_rotation)).
MapVelocity VelocityInMap(const Estimate& estimate);

}  // namespace lio
