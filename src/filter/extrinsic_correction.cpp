// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/extrinsic_correction.hpp"

#include "lio/base/so3.hpp"
#include "lio/filter/map_bend.hpp"

namespace lio {
namespace {

Matrix3 Isotropic(double std) {
  return std * std * Matrix3::Identity();
}

// The right error of a rotation whose roll and pitch are unsure by `std_rad`, and its yaw is not.
Matrix3 TiltCov(const Matrix3& R_world_imu, double std_rad) {
  const Matrix3 in_world = Vector3(std_rad * std_rad, std_rad * std_rad, 0.0).asDiagonal();
  return R_world_imu.transpose() * in_world * R_world_imu;
}

// The twist about the vertical of a rotation in world. It is not YawOf, the heading of the x axis,
// which the tilt in the rotation would move.
Quaternion YawPart(const Quaternion& rotation) {
  return Quaternion(rotation.w(), 0.0, 0.0, rotation.z()).normalized();
}

}  // namespace

void CorrectExtrinsic(const Pose& T_old_new, const Vector3& w_imu_radps, const BiasStds& bias_stds,
                      Estimate& estimate) {
  NavState& state = estimate.state;
  const Vector3 v_old = state.T_world_imu.rotation.conjugate() * state.v_world_imu;
  const Vector3 v_new =
      T_old_new.rotation.conjugate() * (v_old + w_imu_radps.cross(T_old_new.translation));
  state.T_world_imu.rotation = YawPart(state.T_world_imu.rotation * T_old_new.rotation *
                                       state.T_world_imu.rotation.conjugate()) *
                               state.T_world_imu.rotation;
  const Matrix3 R_world_imu = state.T_world_imu.rotation.toRotationMatrix();
  state.v_world_imu = R_world_imu * v_new;
  state.gyro_bias.setZero();
  state.accel_bias.setZero();
  state.T_map_imu = state.T_map_imu * T_old_new;

  const ErrorMatrix before = estimate.cov;
  ErrorMatrix& cov = estimate.cov;
  cov.setZero();
  cov.block<3, 3>(kPos, kPos) = before.block<3, 3>(kPos, kPos);
  cov.block<3, 3>(kRot, kRot) =
      before.block<3, 3>(kRot, kRot) + TiltCov(R_world_imu, kExtrinsicCorrection.tilt_std_rad);
  cov.block<3, 3>(kVel, kVel) = Isotropic(kExtrinsicCorrection.velocity_std_mps);
  cov.block<3, 3>(kGyroBias, kGyroBias) = Isotropic(bias_stds.gyro_radps);
  cov.block<3, 3>(kAccelBias, kAccelBias) = Isotropic(bias_stds.accel_mps2);
  const Matrix6 to_new = AdjointSe3(T_old_new.Inverse());
  cov.block<6, 6>(kMapPose, kMapPose) =
      to_new * before.block<6, 6>(kMapPose, kMapPose) * to_new.transpose();
  MarkMapStart(estimate);
}

}  // namespace lio
