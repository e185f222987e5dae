// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/rotation.hpp"

#include <cmath>

namespace lio {
namespace {

// Below this angle the series' next term is under the rounding of a double.
constexpr double kSmallAngle = 1e-4;

}  // namespace

Matrix3 Hat(const Vector3& a) {
  Matrix3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

Quaternion ExpSo3(const Vector3& phi) {
  const double angle_sq = phi.squaredNorm();
  const double angle = std::sqrt(angle_sq);
  // sin(angle/2) / angle
  const double scale = angle < kSmallAngle ? 0.5 - angle_sq / 48.0 : std::sin(0.5 * angle) / angle;
  const Vector3 v = scale * phi;
  return Quaternion(std::cos(0.5 * angle), v.x(), v.y(), v.z());
}

Vector3 LogSo3(const Quaternion& q) {
  const double sign = q.w() < 0 ? -1.0 : 1.0;
  const Vector3 v = sign * q.vec();
  const double w = sign * q.w();
  const double sine = v.norm();
  // 2 atan2(s, w) / s, by its series where s vanishes.
  const double scale = sine < kSmallAngle ? 2.0 / w * (1.0 - sine * sine / (3.0 * w * w))
                                          : 2.0 * std::atan2(sine, w) / sine;
  return scale * v;
}

double YawOf(const Quaternion& rotation) {
  const Vector3 forward = rotation * Vector3::UnitX();
  return std::atan2(forward.y(), forward.x());
}

Matrix3 LeftJacobianSo3(const Vector3& phi) {
  const double angle_sq = phi.squaredNorm();
  const double angle = std::sqrt(angle_sq);
  const Matrix3 hat = Hat(phi);
  double a = 0.5 - angle_sq / 24.0;         // (1 - cos) / angle^2
  double b = 1.0 / 6.0 - angle_sq / 120.0;  // (angle - sin) / angle^3
  if (angle > 1e-2) {
    a = (1.0 - std::cos(angle)) / angle_sq;
    b = (angle - std::sin(angle)) / (angle_sq * angle);
  } else {
    a += angle_sq * angle_sq / 720.0;
    b += angle_sq * angle_sq / 5040.0;
  }
  return Matrix3::Identity() + a * hat + b * hat * hat;
}

Matrix3 LeftJacobianInverseSo3(const Vector3& phi) {
  const double angle_sq = phi.squaredNorm();
  const double angle = std::sqrt(angle_sq);
  const Matrix3 hat = Hat(phi);
  double c = 1.0 / 12.0 + angle_sq / 720.0 + angle_sq * angle_sq / 30240.0;
  if (angle > 1e-2) {
    c = 1.0 / angle_sq - (1.0 + std::cos(angle)) / (2.0 * angle * std::sin(angle));
  }
  return Matrix3::Identity() - 0.5 * hat + c * hat * hat;
}

}  // namespace lio
