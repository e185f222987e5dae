// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/map_change.hpp"

#include "lio/filter/map_bend.hpp"

namespace lio {
namespace {

// The error of the place [translation; rotation in imu] is one of all states that moved with it.
Eigen::Matrix<double, kStateDim, 6> ErrorsByPlace(const NavState& state) {
  const Matrix3 R_world_imu = state.T_world_imu.rotation.toRotationMatrix();
  const Vector3 up_imu = R_world_imu.transpose() * Vector3::UnitZ();
  Eigen::Matrix<double, kStateDim, 6> J = Eigen::Matrix<double, kStateDim, 6>::Zero();
  J.block<3, 3>(kPos, 0) = R_world_imu;
  J.block<3, 3>(kRot, 3) = up_imu * up_imu.transpose();
  J.block<3, 3>(kVel, 3) = Vector3::UnitZ().cross(state.v_world_imu) * up_imu.transpose();
  J.block<6, 6>(kMapPose, 0).setIdentity();
  return J;
}

}  // namespace

void ChangeMap(const Pose& T_to_map, const Matrix6& cov, Estimate& estimate) {
  NavState& state = estimate.state;
  state.T_map_imu = T_to_map * state.T_map_imu;
  const double yaw_rad = YawOf(state.T_map_imu.rotation * state.T_world_imu.rotation.conjugate());
  const Quaternion turn = ExpSo3(Vector3(0, 0, yaw_rad));
  state.T_world_imu = {(turn * state.T_world_imu.rotation).normalized(),
                       state.T_map_imu.translation};
  state.v_world_imu = turn * state.v_world_imu;
  ErrorMatrix by_turn = ErrorMatrix::Identity();
  by_turn.block<3, 3>(kPos, kPos) = turn.toRotationMatrix();
  by_turn.block<3, 3>(kVel, kVel) = turn.toRotationMatrix();
  const auto by_place = ErrorsByPlace(state);
  estimate.cov =
      by_turn * estimate.cov * by_turn.transpose() + by_place * cov * by_place.transpose();
  MarkMapStart(estimate);
}

}  // namespace lio
