// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/pose.hpp"

#include <cmath>

namespace lio {
namespace {

// Sola et al. eq. (180): the coupling block Q(rho, theta) of the left Jacobian of SE(3).
Matrix3 CouplingBlock(const Vector3& rho, const Vector3& theta) {
  const double a_sq = theta.squaredNorm();
  const double a = std::sqrt(a_sq);
  double c1 = 1.0 / 6.0 - a_sq / 120.0 + a_sq * a_sq / 5040.0;
  double c2 = 1.0 / 24.0 - a_sq / 720.0 + a_sq * a_sq / 40320.0;
  double c3 = 1.0 / 120.0 - a_sq / 2520.0;
  if (a > 0.05) {
    const double sine = std::sin(a);
    const double cosine = std::cos(a);
    c1 = (a - sine) / (a_sq * a);
    c2 = (0.5 * a_sq + cosine - 1.0) / (a_sq * a_sq);
    c3 = 0.5 * (c2 + 3.0 * (a - sine - a_sq * a / 6.0) / (a_sq * a_sq * a));
  }
  const Matrix3 v = Hat(rho);
  const Matrix3 w = Hat(theta);
  const Matrix3 wv = w * v;
  const Matrix3 vw = v * w;
  const Matrix3 wvw = wv * w;
  return 0.5 * v + c1 * (wv + vw + wvw) + c2 * (w * wv + vw * w - 3.0 * wvw) +
         c3 * (wvw * w + w * wvw);
}

}  // namespace

Pose ExpSe3(const Vector6& tangent) {
  const Vector3 rho = tangent.head<3>();
  const Vector3 theta = tangent.tail<3>();
  return {ExpSo3(theta), LeftJacobianSo3(theta) * rho};
}

Vector6 LogSe3(const Pose& pose) {
  const Vector3 theta = LogSo3(pose.rotation);
  Vector6 tangent;
  tangent << LeftJacobianInverseSo3(theta) * pose.translation, theta;
  return tangent;
}

Matrix6 AdjointSe3(const Pose& pose) {
  const Matrix3 rotation = pose.rotation.toRotationMatrix();
  Matrix6 adjoint = Matrix6::Zero();
  adjoint.topLeftCorner<3, 3>() = rotation;
  adjoint.topRightCorner<3, 3>() = Hat(pose.translation) * rotation;
  adjoint.bottomRightCorner<3, 3>() = rotation;
  return adjoint;
}

Matrix6 LeftJacobianSe3(const Vector6& tangent) {
  const Matrix3 left = LeftJacobianSo3(tangent.tail<3>());
  Matrix6 jacobian = Matrix6::Zero();
  jacobian.topLeftCorner<3, 3>() = left;
  jacobian.topRightCorner<3, 3>() = CouplingBlock(tangent.head<3>(), tangent.tail<3>());
  jacobian.bottomRightCorner<3, 3>() = left;
  return jacobian;
}

Matrix6 LeftJacobianInverseSe3(const Vector6& tangent) {
  const Matrix3 inverse = LeftJacobianInverseSo3(tangent.tail<3>());
  Matrix6 jacobian = Matrix6::Zero();
  jacobian.topLeftCorner<3, 3>() = inverse;
  jacobian.topRightCorner<3, 3>() =
      -inverse * CouplingBlock(tangent.head<3>(), tangent.tail<3>()) * inverse;
  jacobian.bottomRightCorner<3, 3>() = inverse;
  return jacobian;
}

Pose Interpolate(const Pose& a, const Pose& b, double fraction) {
  return {a.rotation.slerp(fraction, b.rotation),
          a.translation + fraction * (b.translation - a.translation)};
}

}  // namespace lio
