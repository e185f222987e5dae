// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/estimate_change.hpp"

namespace lio {

void AllowUnseenMotion(Estimate& estimate, const Vector6& motion_var_imu,
                       const Vector3& velocity_var_imu) {
  AddUnseenMotion(estimate, motion_var_imu.asDiagonal());
  const Matrix3 R = estimate.state.T_world_imu.rotation.toRotationMatrix();
  estimate.cov.block<3, 3>(kVel, kVel) += R * velocity_var_imu.asDiagonal() * R.transpose();
}

void AddUnseenMotion(Estimate& estimate, const Matrix6& motion_cov_imu) {
  Eigen::Matrix<double, kStateDim, 6> effect = Eigen::Matrix<double, kStateDim, 6>::Zero();
  effect.block<3, 3>(kPos, 0) = estimate.state.T_world_imu.rotation.toRotationMatrix();
  effect.block<3, 3>(kRot, 3).setIdentity();
  effect.block<6, 6>(kMapPose, 0).setIdentity();
  estimate.cov += effect * motion_cov_imu * effect.transpose();
}

void ForgetBiases(Estimate& estimate) {
  estimate.cov.middleRows<6>(kGyroBias).setZero();
  estimate.cov.middleCols<6>(kGyroBias).setZero();
}

// R Exp(dtheta) u = R u - R [u]x dtheta.
void SetVelocity(const Vector3& v_imu_mps, const Matrix3& cov_world, Estimate& estimate) {
  const Matrix3 R = estimate.state.T_world_imu.rotation.toRotationMatrix();
  ErrorMatrix F = ErrorMatrix::Identity();
  F.block<3, 3>(kVel, kVel).setZero();
  F.block<3, 3>(kVel, kRot) = -R * Hat(v_imu_mps);
  const ErrorMatrix cov = F * estimate.cov * F.transpose();
  estimate.cov = 0.5 * (cov + cov.transpose());
  estimate.cov.block<3, 3>(kVel, kVel) += cov_world;
  estimate.state.v_world_imu = R * v_imu_mps;
}

// The increment is D = (C, t). Position p' = p + R t has the error dp - R [t]x dtheta, rotation R'
// = R C has C^T dtheta, velocity R C R^T v has that of v, turned, and M' = M D has Ad(D^-1) mu.
void MoveTo(const Pose& T_map_imu, Estimate& estimate) {
  NavState& state = estimate.state;
  const Pose D = state.T_map_imu.Inverse() * T_map_imu;
  const Matrix3 R = state.T_world_imu.rotation.toRotationMatrix();
  const Matrix3 C = D.rotation.toRotationMatrix();
  const Matrix3 turn_world = R * C * R.transpose();
  ErrorMatrix F = ErrorMatrix::Identity();
  F.block<3, 3>(kPos, kRot) = -R * Hat(D.translation);
  F.block<3, 3>(kRot, kRot) = C.transpose();
  F.block<3, 3>(kVel, kVel) = turn_world;
  F.block<6, 6>(kMapPose, kMapPose) = AdjointSe3(D.Inverse());
  const ErrorMatrix cov = F * estimate.cov * F.transpose();
  estimate.cov = 0.5 * (cov + cov.transpose());
  state.T_world_imu = state.T_world_imu * D;
  state.v_world_imu = turn_world * state.v_world_imu;
  state.T_map_imu = T_map_imu;
}

}  // namespace lio
