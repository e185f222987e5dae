// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The estimate as it is published: in a world that is level as well as the start knew, and steady.
//
// The filter's own T_world_imu is the best guess of where gravity points, and keeps changing its
// mind while tilt and accelerometer bias are told apart: by tenths of a degree, with a consumer IMU
// by a degree, which at a hundred metres from the origin is metres of height. A path and a map that
// are bent after the fact are of little use, so a steady world is the map's frame, which begins as
// the filter's world and stays where it is. The covariance says what that costs.
#pragma once

#include "lio/filter/nav_state.hpp"

namespace lio {

struct WorldEstimate {
  Pose T_world_imu;
  Vector3 v_world_imu = Vector3::Zero();
  Quaternion R_world_filter = Quaternion::Identity();  // from the filter's own world
  NavCov cov = NavCov::Zero();  // mean square error: variance plus the square of the known step
};

WorldEstimate InSteadyWorld(const Estimate& estimate);
WorldEstimate InFilterWorld(const Estimate& estimate);

}  // namespace lio
