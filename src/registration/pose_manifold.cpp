// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/pose_manifold.hpp"

namespace lio {
namespace {

using PlusMatrix = Eigen::Matrix<double, 7, 6, Eigen::RowMajor>;
using MinusMatrix = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;

// d(q Exp(phi)) / d(phi) at phi = 0, rows x y z w.
Eigen::Matrix<double, 4, 3> QuaternionJacobian(const Quaternion& q) {
  Eigen::Matrix<double, 4, 3> jacobian;
  jacobian << 0.5 * (q.w() * Matrix3::Identity() + Hat(q.vec())), -0.5 * q.vec().transpose();
  return jacobian;
}

}  // namespace

PoseBlock ToBlock(const Pose& pose) {
  PoseBlock block;
  Eigen::Map<Eigen::Vector4d>(block.data()) = pose.rotation.coeffs();
  Eigen::Map<Vector3>(block.data() + 4) = pose.translation;
  return block;
}

Pose ToPose(const double* block) {
  return {Eigen::Map<const Quaternion>(block).normalized(), Eigen::Map<const Vector3>(block + 4)};
}

bool PoseManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  const Pose pose = ToPose(x) * ExpSe3(Eigen::Map<const Vector6>(delta));
  const PoseBlock block = ToBlock(pose);
  std::copy(block.begin(), block.end(), x_plus_delta);
  return true;
}

bool PoseManifold::PlusJacobian(const double* x, double* jacobian) const {
  const Pose pose = ToPose(x);
  Eigen::Map<PlusMatrix> result(jacobian);
  result.setZero();
  result.topRightCorner<4, 3>() = QuaternionJacobian(pose.rotation);
  result.bottomLeftCorner<3, 3>() = pose.rotation.toRotationMatrix();
  return true;
}

bool PoseManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  Eigen::Map<Vector6> result(y_minus_x);
  result = LogSe3(ToPose(x).Inverse() * ToPose(y));
  return true;
}

bool PoseManifold::MinusJacobian(const double* x, double* jacobian) const {
  const Pose pose = ToPose(x);
  Eigen::Map<MinusMatrix> result(jacobian);
  result.setZero();
  // The columns of QuaternionJacobian are orthogonal and half a unit long.
  result.bottomLeftCorner<3, 4>() = 4.0 * QuaternionJacobian(pose.rotation).transpose();
  result.topRightCorner<3, 3>() = pose.rotation.conjugate().toRotationMatrix();
  return true;
}

}  // namespace lio
