// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/nav_state.hpp"

namespace lio {

NavState BoxPlus(const NavState& state, const ErrorVector& error) {
  NavState result;
  result.T_world_imu.translation = state.T_world_imu.translation + error.segment<3>(kPos);
  result.T_world_imu.rotation =
      (state.T_world_imu.rotation * ExpSo3(error.segment<3>(kRot))).normalized();
  result.v_world_imu = state.v_world_imu + error.segment<3>(kVel);
  result.gyro_bias = state.gyro_bias + error.segment<3>(kGyroBias);
  result.accel_bias = state.accel_bias + error.segment<3>(kAccelBias);
  result.T_map_imu = state.T_map_imu * ExpSe3(error.segment<6>(kMapPose));
  result.R_world_map_start =
      (ExpSo3(error.segment<3>(kMapStart)) * state.R_world_map_start).normalized();
  return result;
}

}  // namespace lio
