// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/extrinsic_doubt.hpp"

#include "lio/imu/start_state.hpp"

namespace lio {
namespace {

// How the position moves with the errors [t; theta].
Eigen::Matrix<double, 3, 6> ByErrors(const Pose& T_world_imu) {
  const Matrix3 R = T_world_imu.rotation.toRotationMatrix();
  const Vector3 up_imu = R.transpose() * Vector3::UnitZ();
  Eigen::Matrix<double, 3, 6> by_errors;
  by_errors.leftCols<3>() = R - LevelledRotation(up_imu).toRotationMatrix();
  by_errors.rightCols<3>() = -Vector3::UnitZ().cross(T_world_imu.translation) * up_imu.transpose();
  return by_errors;
}

Vector6 Variances(const ExtrinsicStd& std) {
  Vector6 variances;
  variances << std.lever_m.cwiseAbs2(), std.rotation_rad.cwiseAbs2();
  return variances;
}

}  // namespace

void AddExtrinsicDoubt(const ExtrinsicStd& std, WorldEstimate& estimate) {
  Eigen::Matrix<double, kAccelBias, 6> by_errors = Eigen::Matrix<double, kAccelBias, 6>::Zero();
  by_errors.middleRows<3>(kPos) = ByErrors(estimate.T_world_imu);
  const Vector3 up_imu = estimate.T_world_imu.rotation.conjugate() * Vector3::UnitZ();
  by_errors.block<3, 3>(kVel, 3) =
      -Vector3::UnitZ().cross(estimate.v_world_imu) * up_imu.transpose();
  estimate.cov += by_errors * Variances(std).asDiagonal() * by_errors.transpose();
}

Matrix6 ExtrinsicDoubtInMap(const ExtrinsicStd& std, const Pose& T_map_imu) {
  const Eigen::Matrix<double, 3, 6> by_errors =
      T_map_imu.rotation.conjugate().toRotationMatrix() * ByErrors(T_map_imu);
  Matrix6 cov = Matrix6::Zero();
  cov.topLeftCorner<3, 3>() = by_errors * Variances(std).asDiagonal() * by_errors.transpose();
  return cov;
}

}  // namespace lio
