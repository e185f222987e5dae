// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Defines rigid motions. T_target_source maps source coordinates to target coordinates,
//   p_target = T_target_source * p_source,
// and is the pose of source in target; adjacent names cancel when composing.
// Tangent vectors are ordered [translation (m); rotation (rad)], and perturbations act on the
// right:
//   T(d) = T * ExpSe3(d).
// Formulas: Sola et al., "A micro Lie theory", arXiv 1812.01537, eqs. (172)-(183).
#pragma once

#include "lio/base/rotation.hpp"

namespace lio {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Vector6f = Eigen::Matrix<float, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct Pose {
  Quaternion rotation = Quaternion::Identity();  // unit norm
  Vector3 translation = Vector3::Zero();         // m

  static Pose Identity() { return {}; }

  [[nodiscard]] Pose Inverse() const {
    const Quaternion inverse = rotation.conjugate();
    return {inverse, -(inverse * translation)};
  }
  // The product is renormalized, so that long chains stay rotations.
  friend Pose operator*(const Pose& a, const Pose& b) {
    return {(a.rotation * b.rotation).normalized(), a.rotation * b.translation + a.translation};
  }
  friend Vector3 operator*(const Pose& a, const Vector3& point) {
    return a.rotation * point + a.translation;
  }
};

[[nodiscard]] Pose ExpSe3(const Vector6& tangent);
[[nodiscard]] Vector6 LogSe3(const Pose& pose);

// T ExpSe3(d) = ExpSe3(Adjoint(T) d) T.
[[nodiscard]] Matrix6 AdjointSe3(const Pose& pose);

// ExpSe3(x + d) = ExpSe3(LeftJacobian(x) d) ExpSe3(x) to first order; right likewise.
[[nodiscard]] Matrix6 LeftJacobianSe3(const Vector6& tangent);
[[nodiscard]] Matrix6 LeftJacobianInverseSe3(const Vector6& tangent);
[[nodiscard]] inline Matrix6 RightJacobianInverseSe3(const Vector6& t) {
  return LeftJacobianInverseSe3(-t);
}

// Returns the pose at `fraction` (0..1) of the way from a to b: geodesic rotation, linear
// translation.
[[nodiscard]] Pose Interpolate(const Pose& a, const Pose& b, double fraction);

}  // namespace lio
