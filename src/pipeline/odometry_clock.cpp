// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdio>

#include "pipeline/odometry_impl.hpp"

namespace lio {
namespace {

constexpr double kWorthTelling_s = 1e-3;  // of the offset's standard deviation

}  // namespace

SweepPtr Odometry::Impl::MovedByClockOffset(const SweepPtr& sweep) {
  moved_by_s_ = phase_ == Phase::kRunning && clock_offset_ ? clock_offset_->move_by_s() : 0.0;
  const Duration by = Duration::FromSeconds(moved_by_s_);
  if (by.ns == 0) return sweep;
  auto moved = std::make_shared<Sweep>(*sweep);
  moved->start = moved->start + by;
  moved->end = moved->end + by;
  return moved;
}

// Gated ones as well: a wrong offset is what may have them gated.
void Odometry::Impl::FollowClockOffset(const MatchOutcome& outcome) {
  if (!outcome.match.IsUsable() || outcome.match.degenerate_mask != 0) {
    clock_offset_->Interrupt();
    return;
  }
  const Sweep& sweep = *outcome.sweep;
  const std::vector<ImuSample> samples = history_->SamplesBetween(sweep.start, sweep.end);
  const Matrix3 rotation_cov = outcome.match.cov.bottomRightCorner<3, 3>();
  clock_offset_->Add({sweep.middle(), moved_by_s_, outcome.match.T_map_imu.rotation,
                      options_.filter.registration_cov_scale * rotation_cov.trace() / 3.0,
                      history_->At(sweep.middle()).state.gyro_bias},
                     samples);
  if (has_told_clock_offset_ || clock_offset_->std_s() > kWorthTelling_s) return;
  has_told_clock_offset_ = true;
  const double offset_s = options_.rig.lidar.clock_offset_s + clock_offset_->offset_s();
  char text[160];
  std::snprintf(text, sizeof text,
                "clocks: the lidar's stamps are %.1f ms %s the IMU's (1 sigma %.1f ms): "
                "rig.lidar.clock_offset_s %.4f",
                1e3 * std::abs(offset_s), offset_s < 0 ? "ahead of" : "behind",
                1e3 * clock_offset_->std_s(), offset_s);
  Say(sweep.end, Notice::Severity::kInfo, text);
}

}  // namespace lio
