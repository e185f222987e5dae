// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "pipeline/odometry_impl.hpp"

namespace lio {
namespace {

// A body at rest sways on its springs by so much, to and fro within so long.
constexpr double kStandstillStd_mps = 0.0025;
constexpr double kStandstillCorrelation_s = 0.3;

}  // namespace

// Measurements whose errors last for a time t tell, d apart, as much as independent ones of 2 t / d
// times the variance.
void Odometry::Impl::FuseStandstill(const MatchOutcome& outcome, bool is_fused) {
  if (!use_imu_ || !options_.filter.use_zero_velocity) return;
  const Timestamp middle = outcome.sweep->middle();
  if (!is_fused) return;
  if (outcome.match.degenerate_mask != 0) {
    standstill_.Forget();
    last_standstill_.reset();
    return;
  }
  standstill_.Add({middle, outcome.match.T_map_imu.translation,
                   history_->SamplesBetween(outcome.sweep->start, outcome.sweep->end)});
  if (!standstill_.Judge(history_->At(middle), g_world_)) {
    last_standstill_.reset();
    return;
  }
  const double since_s = std::min(
      last_standstill_ ? SecondsBetween(*last_standstill_, middle) : kStandstillCorrelation_s,
      kStandstillCorrelation_s);
  const double num_alike = std::max(1.0, 2.0 * kStandstillCorrelation_s / since_s);
  const double variance = num_alike * kStandstillStd_mps * kStandstillStd_mps;
  if (history_->AddZeroVelocity(middle, variance) != EventOutcome::kApplied) return;
  last_standstill_ = middle;
  ++counters_.num_standstills;
}

}  // namespace lio
