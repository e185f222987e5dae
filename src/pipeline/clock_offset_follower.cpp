// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/clock_offset_follower.hpp"

#include <fmt/format.h>

#include <cmath>

namespace lio {

ClockOffsetFollower::ClockOffsetFollower(const Options& options, const ClockBelief& belief)
    : options_(&options) {
  if (options.pipeline.use_imu && options.filter.estimate_clock_offset) offset_.emplace(belief);
}

void ClockOffsetFollower::Restart() {
  at_first_scan_ = {};
  Resume();
}

void ClockOffsetFollower::Stop() {
  at_first_scan_ = AtFirstScan();
  offset_.reset();
}

void ClockOffsetFollower::Resume() {
  if (options_->filter.estimate_clock_offset) offset_.emplace();
  is_announced_ = false;
}

std::optional<double> ClockOffsetFollower::error_s() const {
  if (!offset_) return std::nullopt;
  if (offset_->std_s() > kFilterParameters.clock_offset.known_std_s) return ClockOffset::kMax_s;
  return std::abs(offset_->offset_s() - offset_->move_by_s()) + 3.0 * offset_->std_s();
}

ClockBelief ClockOffsetFollower::AtFirstScan() const {
  const bool was_found = at_first_scan_.mean != ClockBelief{}.mean;
  return was_found || !offset_ ? at_first_scan_ : offset_->AtFirstScan();
}

void ClockOffsetFollower::Interrupt() {
  if (offset_) offset_->Interrupt();
}

double ClockOffsetFollower::total_s() const {
  return options_->rig.lidar.clock_offset_s + (offset_ ? offset_->offset_s() : 0.0);
}

Duration ClockOffsetFollower::correction() const {
  return Duration::FromSeconds(offset_ ? offset_->move_by_s() : 0.0);
}

std::optional<std::string> ClockOffsetFollower::AddScan(const MatchOutcome& outcome,
                                                        const FilterHistory& history,
                                                        double gyro_density) {
  if (!offset_) return std::nullopt;
  if (!outcome.match.IsUsable() || outcome.match.degenerate_mask != 0) {
    offset_->Interrupt();
    return std::nullopt;
  }
  const Sweep& sweep = *outcome.sweep;
  const std::vector<ImuSample> samples = history.SamplesBetween(sweep.start, sweep.end);
  const Matrix3 rotation_cov = outcome.match.cov.bottomRightCorner<3, 3>();
  offset_->Add({sweep.middle(), sweep.clock_correction.Seconds(), outcome.match.T_map_imu.rotation,
                options_->filter.registration_cov_scale * rotation_cov.trace() / 3.0,
                history.At(sweep.middle()).state.gyro_bias, gyro_density},
               samples);
  constexpr ClockOffsetParameters kClockOffset = kFilterParameters.clock_offset;
  const bool matters = std::abs(offset_->offset_s()) > kClockOffset.min_announced_s;
  if (is_announced_ || offset_->std_s() > kClockOffset.announced_std_s || !matters)
    return std::nullopt;
  is_announced_ = true;
  return fmt::format(
      "clocks: the lidar's stamps are {:.1f} ms {} the IMU's (1 sigma {:.1f} ms): set "
      "rig.lidar.clock_offset_s: {:.4f}",
      1e3 * std::abs(total_s()), total_s() < 0 ? "ahead of" : "behind", 1e3 * offset_->std_s(),
      total_s());
}

}  // namespace lio
