// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// How well the guess of a match is known, where all axes are known alike.
#pragma once

#include "lio/base/pose.hpp"

namespace lio::test {

inline Matrix6 GuessCov(double translation_std_m, double rotation_std_rad) {
  Vector6 variance;
  variance << Vector3::Constant(translation_std_m * translation_std_m),
      Vector3::Constant(rotation_std_rad * rotation_std_rad);
  return variance.asDiagonal();
}

}  // namespace lio::test
