// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/map_bend.hpp"

namespace lio {
namespace {

Quaternion RotationFromMapToWorld(const NavState& state) {
  return state.T_world_imu.rotation * state.T_map_imu.rotation.conjugate();
}

}  // namespace

// The rotation is D = R_world_imu R_map_imu^T. To first order the right errors of both turn it by
// R_world_imu (dtheta - mu_rotation), along world's axes.
void MarkMapStart(Estimate& estimate) {
  NavState& state = estimate.state;
  state.R_world_map_start = RotationFromMapToWorld(state);
  const Matrix3 R_world_imu = state.T_world_imu.rotation.toRotationMatrix();
  ErrorMatrix J = ErrorMatrix::Identity();
  J.block<3, 3>(kMapStart, kMapStart).setZero();
  J.block<3, 3>(kMapStart, kRot) = R_world_imu;
  J.block<3, 3>(kMapStart, kMapPose + 3) = -R_world_imu;
  estimate.cov = (J * estimate.cov * J.transpose()).eval();
}

Vector3 MapBend(const NavState& state) {
  Vector3 bend = LogSo3(RotationFromMapToWorld(state) * state.R_world_map_start.conjugate());
  bend.z() = 0.0;
  return bend;
}

Pose LevelMapPose(const NavState& state, double share) {
  const Quaternion R_map_world = RotationFromMapToWorld(state).conjugate();
  const Quaternion turn = ExpSo3(share * MapBend(state));
  return {(R_map_world * turn * state.T_world_imu.rotation).normalized(),
          state.T_map_imu.translation};
}

}  // namespace lio
