// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/nav_state.hpp"

#include "lio/base/rotation.hpp"

namespace lio {
namespace {

// The right error of T_world_imu [m; rad, in imu].
Vector6 WorldPoseError(const NavState& state, const ErrorVector& error) {
  Vector6 right;
  right << state.T_world_imu.rotation.conjugate() * error.segment<3>(kPos), error.segment<3>(kRot);
  return right;
}

}  // namespace

NavState BoxPlus(const NavState& state, const ErrorVector& error) {
  NavState result;
  result.T_world_imu.translation = state.T_world_imu.translation + error.segment<3>(kPos);
  result.T_world_imu.rotation =
      (state.T_world_imu.rotation * ExpSo3(error.segment<3>(kRot))).normalized();
  result.v_world_imu = state.v_world_imu + error.segment<3>(kVel);
  result.gyro_bias = state.gyro_bias + error.segment<3>(kGyroBias);
  result.accel_bias = state.accel_bias + error.segment<3>(kAccelBias);
  result.T_map_imu = state.T_map_imu * ExpSe3(error.segment<6>(kMapPose));
  result.R_world_map_start =
      (ExpSo3(error.segment<3>(kMapStart)) * state.R_world_map_start).normalized();
  return result;
}

NavState Inject(const NavState& state, const ErrorVector& error) {
  NavState result = BoxPlus(state, error);
  const Vector6 common = error.segment<6>(kMapPose);
  result.T_world_imu =
      state.T_world_imu * ExpSe3(WorldPoseError(state, error) - common) * ExpSe3(common);
  return result;
}

ErrorMatrix InjectJacobian(const NavState& state, const ErrorVector& error) {
  const Vector6 common = error.segment<6>(kMapPose);
  const Vector6 apart = WorldPoseError(state, error) - common;
  const Matrix6 by_common = LeftJacobianSe3(-common);  // the right Jacobian
  const Matrix6 by_apart = AdjointSe3(ExpSe3(-common)) * LeftJacobianSe3(-apart);
  const Matrix3 R_before = state.T_world_imu.rotation.toRotationMatrix();
  const Matrix3 R_after = R_before * (ExpSo3(apart.tail<3>()) * ExpSo3(common.tail<3>()));
  // Position errors are in world, and right errors in imu.
  Matrix6 from_position = Matrix6::Identity();
  from_position.topLeftCorner<3, 3>() = R_before.transpose();
  Matrix6 to_position = Matrix6::Identity();
  to_position.topLeftCorner<3, 3>() = R_after;
  ErrorMatrix J = ErrorMatrix::Identity();
  J.block<6, 6>(kPos, kPos) = to_position * by_apart * from_position;
  J.block<6, 6>(kPos, kMapPose) = to_position * (by_common - by_apart);
  J.block<6, 6>(kMapPose, kMapPose) = by_common;
  J.block<3, 3>(kMapStart, kMapStart) =
      RightJacobianSo3(-error.segment<3>(kMapStart));  // a left error
  return J;
}

}  // namespace lio
