// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/gravity_check.hpp"

#include <cmath>

namespace lio {

bool GravityContradicts(std::span<const ImuSample> samples, const Estimate& from,
                        const Estimate& to, const Vector3& g_world, const Biases& biases) {
  if (samples.empty()) return false;
  const double span_s = SecondsBetween(from.stamp, to.stamp);
  const Vector3 felt_mps = Preintegrate(samples, from.stamp, to.stamp, biases, {}).velocity;
  const Vector3 change_mps = to.state.v_world_imu - from.state.v_world_imu - span_s * g_world;
  const Vector3 expected_mps = from.state.T_world_imu.rotation.conjugate() * change_mps;
  const double velocity_var =
      (from.cov.diagonal().segment<3>(kVel) + to.cov.diagonal().segment<3>(kVel)).maxCoeff();
  return (felt_mps - expected_mps).norm() > kGravityCheck.max_off_ratio * span_s * g_world.norm() +
                                                kGravityCheck.sigmas * std::sqrt(velocity_var);
}

}  // namespace lio
