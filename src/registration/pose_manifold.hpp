// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Defines a pose as one parameter block of Ceres: seven numbers qx qy qz qw tx ty tz, unit
// quaternion, on a manifold of six dimensions. The tangent is this project's: [translation;
// rotation], acting on the right, T(d) = T ExpSe3(d) (base/pose.hpp).
#pragma once

#include <ceres/manifold.h>

#include <array>

#include "lio/base/pose.hpp"

namespace lio {

using PoseBlock = std::array<double, 7>;

PoseBlock ToBlock(const Pose& pose);
Pose ToPose(const double* block);

class PoseManifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

}  // namespace lio
