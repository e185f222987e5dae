// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Lets the filter take absolute poses, such as those of motion capture or of a surveyed map.
#pragma once

#include "lio/filter/nav_state.hpp"

namespace lio::test {

// Makes the map's frame the world's. T_map_imu becomes T_world_imu with the same error, so that
// FusePose measures both. Neither BlendMapPose nor a rebase may follow. The two poses stay equal to
// second order of errors.
inline void MakeMapTheWorld(Estimate& estimate) {
  NavState& state = estimate.state;
  state.T_map_imu = state.T_world_imu;
  // mu = (R^T dp, dtheta).
  ErrorMatrix J = ErrorMatrix::Identity();
  J.block<6, 6>(kMapPose, kMapPose).setZero();
  J.block<3, 3>(kMapPose, kPos) = state.T_world_imu.rotation.conjugate().toRotationMatrix();
  J.block<3, 3>(kMapPose + 3, kRot).setIdentity();
  estimate.cov = (J * estimate.cov * J.transpose()).eval();
}

}  // namespace lio::test
