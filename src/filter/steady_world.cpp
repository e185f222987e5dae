// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/steady_world.hpp"

namespace lio {

WorldEstimate InFilterWorld(const Estimate& estimate) {
  const NavState& state = estimate.state;
  return {state.T_world_imu, state.v_world_imu, Quaternion::Identity(),
          estimate.cov.topLeftCorner<kAccelBias, kAccelBias>()};
}

WorldEstimate InSteadyWorld(const Estimate& estimate) {
  const NavState& state = estimate.state;
  WorldEstimate steady = InFilterWorld(estimate);
  steady.T_world_imu = state.T_map_imu;
  steady.R_world_filter = state.T_map_imu.rotation * state.T_world_imu.rotation.conjugate();
  steady.v_world_imu = steady.R_world_filter * state.v_world_imu;
  Eigen::Matrix<double, kAccelBias, 1> step;
  step << state.T_world_imu.translation - steady.T_world_imu.translation,
      LogSo3(steady.T_world_imu.rotation.conjugate() * state.T_world_imu.rotation),
      state.v_world_imu - steady.v_world_imu, Vector3::Zero();
  steady.cov += step * step.transpose();
  return steady;
}

}  // namespace lio
