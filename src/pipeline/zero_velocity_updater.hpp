// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Fuses that the vehicle stands still (filter.use_zero_velocity), judged by ZeroVelocityDetector.
#pragma once

#include <optional>

#include "lio/filter/filter_history.hpp"
#include "lio/pipeline/match_job.hpp"
#include "pipeline/zero_velocity_detector.hpp"

namespace lio {

struct ZeroVelocityParameters {
  // A body at rest sways on its springs by so much, to and fro within so long. Measured on a
  // simulated car with an idling engine: docs/experiments/zero_velocity.md.
  double std_mps = 0.0025;
  double correlation_s = 0.3;
  // At rest the same beams meet the same cells, and errors last. Measured: over five seconds they
  // come to one to four times the variance that independent ones would have
  // (docs/experiments/zero_velocity.md).
  double matches_alike = 4.0;
};

inline constexpr ZeroVelocityParameters kZeroVelocity;

class ZeroVelocityUpdater {
 public:
  // `is_at_rest`: the next scan finds the vehicle at rest.
  ZeroVelocityUpdater(const ImuRig& imu, bool is_at_rest) : detector_(imu) {
    if (is_at_rest) detector_.BeginAtRest();
  }

  // Call it after a scan that was fused. True: the filter took the velocity for zero.
  [[nodiscard]] bool AddFusedScan(const MatchOutcome& outcome, const Vector3& g_world,
                                  FilterHistory& history);
  // The time before says nothing about now.
  void Forget() {
    detector_.Forget();
    last_.reset();
  }

  // Returns the factor on the covariance of the next match.
  double match_cov_factor() const { return last_ ? kZeroVelocity.matches_alike : 1.0; }

 private:
  ZeroVelocityDetector detector_;
  std::optional<Timestamp> last_;  // middle of the last sweep that was taken at rest
};

}  // namespace lio
