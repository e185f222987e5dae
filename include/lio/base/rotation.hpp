// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Defines exponential, logarithm and Jacobians of SO(3). Rotation vectors in radians, right
// perturbation everywhere in this project: R(phi + d) = R(phi) Exp(RightJacobian(phi) d). Formulas:
// Sola, Deray, Atchuthan, "A micro Lie theory", arXiv 1812.01537, eqs. (132)-(146). The same on any
// scalar, as cost functions of Ceres need it, is base/so3.hpp.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace lio {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;

// Skew-symmetric matrix with Hat(a) b = a x b.
[[nodiscard]] Matrix3 Hat(const Vector3& a);

// Returns the rotation by |phi| about phi. It is exact to rounding for every |phi|, the smallest
// included.
[[nodiscard]] Quaternion ExpSo3(const Vector3& phi);

// Inverse of ExpSo3 with |result| <= pi; the sign of q does not matter. q must have unit norm.
[[nodiscard]] Vector3 LogSo3(const Quaternion& q);

// Returns the angle about z of the rotated x axis, within -pi to pi [rad]; 0 where that axis is
// vertical.
[[nodiscard]] double YawOf(const Quaternion& rotation);

// Exp(phi + d) = Exp(LeftJacobian(phi) d) Exp(phi) to first order; right likewise from the right.
[[nodiscard]] Matrix3 LeftJacobianSo3(const Vector3& phi);
[[nodiscard]] Matrix3 LeftJacobianInverseSo3(const Vector3& phi);
[[nodiscard]] inline Matrix3 RightJacobianSo3(const Vector3& phi) {
  return LeftJacobianSo3(-phi);
}

}  // namespace lio
