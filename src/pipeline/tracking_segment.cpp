// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gaps of the inertial stream and steps of its clock, while tracking.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lio/pipeline/tracking.hpp"
#include "lio/sensor/gap.hpp"
#include "pipeline/history_options.hpp"

namespace lio {
namespace {

constexpr double kMaxUnknown_s = kImuGap.unknown.Seconds();

}  // namespace

// After a long gap or a step of the clock the state goes on from where it was, unsure of what
// happened in between, at the new time. Where a clock was set, messages went on meanwhile.
void Tracking::StartSegment(const SegmentStarts& segment) {
  using Step = ImuPreprocessor::Step;
  context_.sweeps.clear();
  ++context_.counters.num_restarts;
  const Timestamp first = segment.first.stamp;
  Estimate estimate = history_.head();
  const double jump_s = SecondsBetween(estimate.stamp, first);
  const bool is_gap = segment.step == Step::kGap && jump_s >= 0.0 && jump_s < kMaxUnknown_s;
  double unknown_s = is_gap ? jump_s : std::clamp(jump_s, kTracking.clock_set_s, kMaxUnknown_s);
  if (segment.step == Step::kSetRight) unknown_s = kTracking.clock_set_s;
  ImuSample coast;  // straight on, without turning
  coast.stamp = estimate.stamp;
  coast.w_imu_radps = estimate.state.gyro_bias;
  coast.f_imu_mps2 =
      estimate.state.accel_bias - estimate.state.T_world_imu.rotation.conjugate() * g_world_;
  ImuSample end = coast;
  end.stamp = coast.stamp + Duration::FromSeconds(unknown_s);
  const HistoryOptions history = MakeHistoryOptions(context_.options, context_.nis_limit, g_world_,
                                                    context_.stream.imu().NoiseAt(first));
  ProcessNoise noise = history.noise;
  noise.accel_density = history.imu_outage.gap_accel_std_mps2 * std::sqrt(unknown_s);
  noise.gyro_density = history.imu_outage.gap_gyro_std_radps * std::sqrt(unknown_s);
  const NavState before = estimate.state;
  if (unknown_s > 0.0) Propagate(estimate, coast, end, noise, g_world_);
  handover_.clock_step.reset();
  if (is_gap) {
    handover_.clock_step = {{coast.stamp, first}, before.T_map_imu};
  } else {
    estimate.state = before;
    const Duration by = Duration::FromSeconds(jump_s - unknown_s);
    handover_.ShiftTimesBy(by);
    health_.ShiftTimesBy(by);
    context_.clocks.Interrupt();
  }
  estimate.stamp = first;
  history_ = FilterHistory(history, estimate, segment.first);
  zero_velocity_.Forget();
  handover_.last_published.reset();
  context_.outputs.Notify(
      first, Notice::Severity::kWarning,
      fmt::format("the IMU's stamps jumped by {:.3f} s: the state is carried over", jump_s));
}

void Tracking::TakeClockStep(const AmbiguousClockStep& step) {
  handover_.clock_step = {step.stamps, std::nullopt};
}

bool Tracking::IsAfterClockStep(const Sweep& sweep) const {
  return handover_.clock_step && sweep.middle() > handover_.clock_step->stamps.before;
}

// The pose of a sweep after the step if no time has passed there: the motion since, from before it.
std::optional<Pose> Tracking::PoseIfClockSet(const Sweep& sweep,
                                             const Pose& T_map_imu_predicted) const {
  if (!IsAfterClockStep(sweep)) return std::nullopt;
  const auto& [stamps, T_map_before] = *handover_.clock_step;
  const auto& last_located = handover_.last_located;
  if (last_located && *last_located > stamps.before) return std::nullopt;  // located meanwhile
  const Pose before = T_map_before ? *T_map_before : history_.At(stamps.before).state.T_map_imu;
  return before * (history_.At(stamps.after).state.T_map_imu.Inverse() * T_map_imu_predicted);
}

void Tracking::SettleClockStep(const MatchOutcome& outcome) {
  if (!IsAfterClockStep(*outcome.sweep)) return;
  if (outcome.is_clock_set) {
    const ClockStep& stamps = handover_.clock_step->stamps;
    ++context_.counters.num_clock_jumps;
    context_.outputs.Notify(
        outcome.sweep->end, Notice::Severity::kWarning,
        fmt::format("stamps of all sensors went forth by {:.3f} s but nothing moved meanwhile: the "
                    "clock was set, and the state is carried over",
                    SecondsBetween(stamps.before, stamps.after)));
  }
  handover_.clock_step.reset();
}

}  // namespace lio
