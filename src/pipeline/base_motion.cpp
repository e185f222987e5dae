// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/base_motion.hpp"

namespace lio {

BaseMotion MoveToBase(const NavOutput& nav, const NavCov& cov, double rate_var,
                      const Pose& T_base_imu) {
  const Pose T_imu_base = T_base_imu.Inverse();
  const Vector3& r_imu = T_imu_base.translation;
  const Vector3 turning = nav.w_imu_radps.cross(r_imu);  // velocity of base against imu, in imu
  BaseMotion base;
  base.T_world_base = nav.T_world_imu * T_imu_base;
  base.v_world_base_mps = nav.v_world_imu_mps + nav.T_world_imu.rotation * turning;
  base.w_base_radps = T_base_imu.rotation * nav.w_imu_radps;
  base.T_map_base = nav.T_map_imu * T_imu_base;

  const Matrix3 R = nav.T_world_imu.rotation.toRotationMatrix();
  const Matrix3 lever = R * Hat(r_imu);
  constexpr int kRows = kGyroBias;  // position, rotation, velocity of base
  Eigen::Matrix<double, kRows, kAccelBias> J = Eigen::Matrix<double, kRows, kAccelBias>::Zero();
  J.block<3, 3>(kPos, kPos).setIdentity();
  J.block<3, 3>(kPos, kRot) = -lever;
  J.block<3, 3>(kRot, kRot) = T_base_imu.rotation.toRotationMatrix();
  J.block<3, 3>(kVel, kRot) = -R * Hat(turning);
  J.block<3, 3>(kVel, kVel).setIdentity();
  J.block<3, 3>(kVel, kGyroBias) = lever;
  const Eigen::Matrix<double, kRows, kRows> base_cov = J * cov * J.transpose();
  base.pose_cov = base_cov.topLeftCorner<6, 6>();
  base.velocity_cov = base_cov.block<3, 3>(kVel, kVel) + rate_var * lever * lever.transpose();
  const Matrix6 adjoint = AdjointSe3(T_base_imu);
  base.map_pose_cov = adjoint * nav.map_pose_cov * adjoint.transpose();
  return base;
}

}  // namespace lio
