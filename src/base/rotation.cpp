// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/rotation.hpp"

#include <cmath>

#include "lio/base/so3.hpp"

namespace lio {

Matrix3 Hat(const Vector3& a) {
  return so3::Hat<double>(a);
}

Quaternion ExpSo3(const Vector3& phi) {
  return so3::Exp<double>(phi);
}

Vector3 LogSo3(const Quaternion& q) {
  return so3::Log<double>(q);
}

double YawOf(const Quaternion& rotation) {
  const Vector3 forward = rotation * Vector3::UnitX();
  return std::atan2(forward.y(), forward.x());
}

Matrix3 LeftJacobianSo3(const Vector3& phi) {
  return so3::LeftJacobian<double>(phi);
}

Matrix3 LeftJacobianInverseSo3(const Vector3& phi) {
  return so3::LeftJacobianInverse<double>(phi);
}

}  // namespace lio
