// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Defines SO(3) on any scalar: double for the estimator (base/rotation.hpp has the same functions
// under names of their own), ceres::Jet for cost functions. Rotation vectors are in radians,
// Jacobians are by perturbations as base/rotation.hpp defines them. Every function is finite and
// has the right derivative at the identity, too. Source: Sola, Deray, Atchuthan, "A micro Lie
// theory", arXiv 1812.01537, eqs. (132)-(146).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace lio::so3 {

template <class T>
using Vec3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using Mat3 = Eigen::Matrix<T, 3, 3>;

// Exp and Log use two terms of their series below this angle [rad]. Arithmetic: the third one,
// about angle^4 / 2000, is under the rounding of a double.
inline constexpr double kSmallAngle_rad = 1e-4;
// The Jacobians divide by the angle's square or cube, which cancels earlier; they use three terms
// below this angle [rad]. Arithmetic: the fourth one, at most angle^6 / 20 000 of the first, is
// under the rounding of a double.
inline constexpr double kSmallJacobianAngle_rad = 1e-2;

// Returns the square root, with a derivative of zero where x is zero: that of an even function's
// argument.
template <class T>
T Root(const T& x) {
  using std::sqrt;
  if (x == T(0.0)) return T(0.0);
  return sqrt(x);
}

// Skew-symmetric matrix with Hat(a) b = a x b.
template <class T>
[[nodiscard]] Mat3<T> Hat(const Vec3<T>& a) {
  Mat3<T> m;
  m << T(0.0), -a.z(), a.y(), a.z(), T(0.0), -a.x(), -a.y(), a.x(), T(0.0);
  return m;
}

// Returns the rotation by |phi| about phi.
template <class T>
[[nodiscard]] Eigen::Quaternion<T> Exp(const Vec3<T>& phi) {
  using std::cos;
  using std::sin;
  const T angle_sq = phi.squaredNorm();
  const T angle = Root(angle_sq);
  // The scale is sin(angle/2) / angle.
  const T scale =
      angle < T(kSmallAngle_rad) ? T(T(0.5) - angle_sq / T(48.0)) : T(sin(T(0.5) * angle) / angle);
  const Vec3<T> v = scale * phi;
  return Eigen::Quaternion<T>(cos(T(0.5) * angle), v.x(), v.y(), v.z());
}

// Inverse of Exp with |result| <= pi; the sign of q does not matter. q must have unit norm.
template <class T>
[[nodiscard]] Vec3<T> Log(const Eigen::Quaternion<T>& q) {
  using std::atan2;
  const T sign = q.w() < T(0.0) ? T(-1.0) : T(1.0);
  const Vec3<T> v = sign * q.vec();
  const T w = sign * q.w();
  const T sine = Root(T(v.squaredNorm()));
  // 2 atan2(s, w) / s, by its series where s vanishes.
  const T scale = sine < T(kSmallAngle_rad)
                      ? T(T(2.0) / w * (T(1.0) - sine * sine / (T(3.0) * w * w)))
                      : T(T(2.0) * atan2(sine, w) / sine);
  return scale * v;
}

// Exp(phi + d) = Exp(LeftJacobian(phi) d) Exp(phi) to first order in d.
template <class T>
[[nodiscard]] Mat3<T> LeftJacobian(const Vec3<T>& phi) {
  using std::cos;
  using std::sin;
  const T angle_sq = phi.squaredNorm();
  const T angle = Root(angle_sq);
  const Mat3<T> hat = Hat<T>(phi);
  T a = T(0.5) - angle_sq / T(24.0);         // (1 - cos) / angle^2
  T b = T(1.0 / 6.0) - angle_sq / T(120.0);  // (angle - sin) / angle^3
  if (angle > T(kSmallJacobianAngle_rad)) {
    a = (T(1.0) - cos(angle)) / angle_sq;
    b = (angle - sin(angle)) / (angle_sq * angle);
  } else {
    a += angle_sq * angle_sq / T(720.0);
    b += angle_sq * angle_sq / T(5040.0);
  }
  return Mat3<T>::Identity() + a * hat + b * hat * hat;
}

template <class T>
[[nodiscard]] Mat3<T> LeftJacobianInverse(const Vec3<T>& phi) {
  using std::cos;
  using std::sin;
  const T angle_sq = phi.squaredNorm();
  const T angle = Root(angle_sq);
  const Mat3<T> hat = Hat<T>(phi);
  T c = T(1.0 / 12.0) + angle_sq / T(720.0) + angle_sq * angle_sq / T(30240.0);
  if (angle > T(kSmallJacobianAngle_rad)) {
    c = T(1.0) / angle_sq - (T(1.0) + cos(angle)) / (T(2.0) * angle * sin(angle));
  }
  return Mat3<T>::Identity() - T(0.5) * hat + c * hat * hat;
}

}  // namespace lio::so3
