// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A match that the gate refused since it has turned otherwise than the gyro says, or has moved
// otherwise than the accelerometer says: one of both is wrong, and no single scan tells which. The
// next scan is sought where the match leads, and what is published holds either. A match that has
// not turned, and is farther off than a force leads, is wrong itself and foretells nothing.
#pragma once

#include <algorithm>

#include "lio/filter/published_estimate.hpp"
#include "pipeline/scan_step.hpp"

namespace lio {

struct GateDoubt {
  // The match is off its prediction by this, a right increment [translation (m); rotation (rad)].
  Vector6 by = Vector6::Zero();
  Timestamp stamp;     // the match has it
  Timestamp last_fix;  // the last scan that was fused before has it

  // Returns the same at another instant: it grows as the error of a rate does.
  [[nodiscard]] Vector6 At(Timestamp instant) const {
    const double until_gated_s =
        std::max(kScanStep.min_since_last_fix_s, SecondsBetween(last_fix, stamp));
    const double growth = SecondsBetween(last_fix, instant) / until_gated_s;
    return std::clamp(growth, 0.0, kScanStep.max_growth_of_gated) * by;
  }
  // Can an accelerometer that is off have led the prediction away by the shift?
  [[nodiscard]] bool IsWithinReachOfForces() const {
    const double since_s = SecondsBetween(last_fix, stamp);
    return by.head<3>().norm() <= 0.5 * kScanStep.max_force_error_mps2 * since_s * since_s;
  }
};

// Adds what it makes of the covariance.
inline void AddGateDoubt(const GateDoubt& doubt, Timestamp stamp, WorldEstimate& estimate) {
  const Vector6 by = doubt.At(stamp);
  Eigen::Matrix<double, kAccelBias, 1> error = Eigen::Matrix<double, kAccelBias, 1>::Zero();
  error.segment<3>(kPos) = estimate.T_world_imu.rotation * by.head<3>();
  error.segment<3>(kRot) = by.tail<3>();
  estimate.cov += error * error.transpose();
}

[[nodiscard]] inline Matrix6 GateDoubtInMap(const GateDoubt& doubt, Timestamp stamp) {
  const Vector6 by = doubt.At(stamp);
  return by * by.transpose();
}

}  // namespace lio
