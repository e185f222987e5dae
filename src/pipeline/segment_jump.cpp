// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/segment_jump.hpp"

#include <algorithm>
#include <cmath>

namespace lio {
namespace {

constexpr double kMaxUnknown_s = kImuGap.unknown.Seconds();

// Messages went on while a clock was set.
double UnknownAtSetClock_s(ImuPreprocessor::Step step, double jump_s) {
  if (step == ImuPreprocessor::Step::kSetRight) return kSegmentJump.clock_set_s;
  return std::clamp(jump_s, kSegmentJump.clock_set_s, kMaxUnknown_s);
}

// The body goes straight on for so long, without turning, as unsure as after a gap of the samples.
Estimate Coasted(Estimate estimate, double unknown_s, const HistoryOptions& options) {
  if (unknown_s <= 0.0) return estimate;
  ImuSample coast;
  coast.stamp = estimate.stamp;
  coast.w_imu_radps = estimate.state.gyro_bias;
  coast.f_imu_mps2 =
      estimate.state.accel_bias - estimate.state.T_world_imu.rotation.conjugate() * options.g_world;
  ImuSample end = coast;
  end.stamp = coast.stamp + Duration::FromSeconds(unknown_s);
  ProcessNoise noise = options.noise;
  noise.accel_density = options.imu_outage.gap_accel_std_mps2 * std::sqrt(unknown_s);
  noise.gyro_density = options.imu_outage.gap_gyro_std_radps * std::sqrt(unknown_s);
  Propagate(estimate, coast, end, noise, options.g_world);
  return estimate;
}

}  // namespace

SegmentJump JudgeJump(Timestamp before, const SegmentStarts& segment) {
  using Kind = SegmentJump::Kind;
  const double jump_s = SecondsBetween(before, segment.first.stamp);
  if (jump_s <= -kMaxUnknown_s) return {Kind::kSetFarBack, jump_s};
  const bool is_gap = segment.step == ImuPreprocessor::Step::kGap && jump_s >= 0.0;
  if (!is_gap) return {Kind::kClockSet, jump_s, UnknownAtSetClock_s(segment.step, jump_s)};
  if (jump_s >= kMaxUnknown_s) return {Kind::kUnseen, jump_s};
  return {Kind::kGap, jump_s, jump_s};
}

Estimate CarriedOver(const Estimate& before, const SegmentJump& jump, Timestamp first,
                     const HistoryOptions& options) {
  Estimate estimate = Coasted(before, jump.unknown_s, options);
  if (jump.kind == SegmentJump::Kind::kClockSet) estimate.state = before.state;
  estimate.stamp = first;
  return estimate;
}

}  // namespace lio
