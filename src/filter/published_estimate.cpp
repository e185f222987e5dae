// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/published_estimate.hpp"

namespace lio {
namespace {

Vector3 VelocityInImu(const NavState& state) {
  return state.T_world_imu.rotation.conjugate() * state.v_world_imu;
}

}  // namespace

WorldEstimate InWorld(const Estimate& estimate) {
  const NavState& state = estimate.state;
  return {state.T_world_imu, state.v_world_imu,
          estimate.cov.topLeftCorner<kAccelBias, kAccelBias>()};
}

WorldEstimate WithMapAsWorld(const Estimate& estimate) {
  const NavState& state = estimate.state;
  WorldEstimate world = InWorld(estimate);
  world.T_world_imu = state.T_map_imu;
  world.v_world_imu = state.T_map_imu.rotation * VelocityInImu(state);
  Eigen::Matrix<double, kAccelBias, 1> step;
  step << state.T_world_imu.translation - world.T_world_imu.translation,
      LogSo3(world.T_world_imu.rotation.conjugate() * state.T_world_imu.rotation),
      state.v_world_imu - world.v_world_imu, Vector3::Zero();
  world.cov += step * step.transpose();
  return world;
}

MapVelocity VelocityInMap(const Estimate& estimate) {
  const NavState& state = estimate.state;
  const Matrix3 R_imu_world = state.T_world_imu.rotation.conjugate().toRotationMatrix();
  const Matrix3 R_map_imu = state.T_map_imu.rotation.toRotationMatrix();
  const Vector3 v_imu = VelocityInImu(state);
  const Matrix3 by_turn = R_map_imu * Hat(v_imu);
  Eigen::Matrix<double, 3, kStateDim> J = Eigen::Matrix<double, 3, kStateDim>::Zero();
  J.block<3, 3>(0, kVel) = R_map_imu * R_imu_world;
  J.block<3, 3>(0, kRot) = by_turn;
  J.block<3, 3>(0, kMapPose + 3) = -by_turn;
  return {state.T_map_imu.rotation * v_imu, J * estimate.cov * J.transpose()};
}

}  // namespace lio
