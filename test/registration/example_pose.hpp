// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A pose that registration is to find, and how well a guess may know one.
#pragma once

#include "lio/base/pose.hpp"

namespace lio::test {

inline const Pose kLoamTruth{ExpSo3(Vector3(0.05, -0.1, 0.3)), Vector3(0.5, -0.8, 0.2)};

// Returns the covariance of a pose that is as sure along and about each axis as any other.
inline Matrix6 IsotropicCov(double translation_std_m, double rotation_std_rad) {
  Vector6 variance;
  variance << Vector3::Constant(translation_std_m * translation_std_m),
      Vector3::Constant(rotation_std_rad * rotation_std_rad);
  return variance.asDiagonal();
}

}  // namespace lio::test
