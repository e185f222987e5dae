// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/zero_velocity_updater.hpp"

#include <algorithm>

namespace lio {

// The errors of measurements in a row are correlated for a time t. Measurements at intervals d tell
// as much as independent ones whose variance is 2 t / d times as large.
bool ZeroVelocityUpdater::AddFusedScan(const MatchOutcome& outcome, const Vector3& g_world,
                                       FilterHistory& history) {
  if (outcome.match.degenerate_mask != 0) {
    detector_.Forget();
    last_.reset();
    return false;
  }
  const Timestamp middle = outcome.sweep->middle();
  detector_.Add({middle, outcome.match.T_map_imu.translation,
                 history.SamplesBetween(outcome.sweep->start, outcome.sweep->end)});
  if (!detector_.Judge(history.At(middle), g_world)) {
    last_.reset();
    return false;
  }
  const double since_s =
      std::min(last_ ? SecondsBetween(*last_, middle) : kZeroVelocity.correlation_s,
               kZeroVelocity.correlation_s);
  const double num_alike = std::max(1.0, 2.0 * kZeroVelocity.correlation_s / since_s);
  const double variance = num_alike * kZeroVelocity.std_mps * kZeroVelocity.std_mps;
  if (history.AddZeroVelocity(middle, variance) != EventOutcome::kApplied) return false;
  last_ = middle;
  return true;
}

}  // namespace lio
