// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/zero_velocity_updater.hpp"

#include <cmath>

namespace lio {
namespace {

// The errors of measurements in a row are correlated by exp(-d / t) at an interval d: in the long
// run they tell as much as independent ones of so many times their variance (of the mean of a
// first-order autoregressive process).
double NumAlike(double since_s) {
  const double correlation = std::exp(-since_s / kZeroVelocity.correlation_s);
  return (1.0 + correlation) / (1.0 - correlation);
}

}  // namespace

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
  const bool is_after_last = last_ && *last_ < middle;
  const double since_s =
      is_after_last ? SecondsBetween(*last_, middle) : kZeroVelocity.correlation_s;
  const double variance = NumAlike(since_s) * kZeroVelocity.std_mps * kZeroVelocity.std_mps;
  if (history.AddZeroVelocity(middle, variance) != EventOutcome::kApplied) return false;
  last_ = middle;
  return true;
}

}  // namespace lio
