// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Returns the difference of two states, by the conventions of filter/nav_state.hpp.
#pragma once

#include "lio/filter/nav_state.hpp"

namespace lio::test {

// Returns the error with BoxPlus(b, BoxMinus(a, b)) == a.
inline ErrorVector BoxMinus(const NavState& a, const NavState& b) {
  ErrorVector error;
  error << a.T_world_imu.translation - b.T_world_imu.translation,
      LogSo3(b.T_world_imu.rotation.conjugate() * a.T_world_imu.rotation),
      a.v_world_imu - b.v_world_imu, a.gyro_bias - b.gyro_bias, a.accel_bias - b.accel_bias,
      LogSe3(b.T_map_imu.Inverse() * a.T_map_imu),
      LogSo3(a.R_world_map_start * b.R_world_map_start.conjugate());
  return error;
}

}  // namespace lio::test
