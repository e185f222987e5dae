// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tracking goes on across gaps of the inertial stream and steps of its clock.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lio/sensor/gap.hpp"
#include "pipeline/tracking.hpp"

namespace lio {
namespace {

constexpr double kMaxUnknown_s = kImuGap.unknown.Seconds();

// Messages went on while a clock was set.
double UnknownAtSetClock_s(ImuPreprocessor::Step step, double jump_s) {
  if (step == ImuPreprocessor::Step::kSetRight) return kTracking.clock_set_s;
  return std::clamp(jump_s, kTracking.clock_set_s, kMaxUnknown_s);
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

// After a gap or a step of the clock the state goes on from where it was, unsure of what happened
// in between, at the new time.
void Tracking::StartSegment(const SegmentStarts& segment) {
  context_.ForgetSweeps(context_.sweeps.size());
  handover_.clock_step.End();
  handover_.last_published.reset();
  zero_velocity_.Forget();
  const Timestamp first = segment.first.stamp;
  const Estimate before = history_.head();
  const double jump_s = SecondsBetween(before.stamp, first);
  if (jump_s <= -kMaxUnknown_s) {
    SeekAfterSetBack(before, segment);
    return;
  }
  const bool is_gap = segment.step == ImuPreprocessor::Step::kGap && jump_s >= 0.0;
  if (is_gap && jump_s >= kMaxUnknown_s) {
    SeekAfterOutage(before, segment,
                    fmt::format("by their stamps nothing came of all sensors for {:.3f} s, or "
                                "their clocks were set",
                                jump_s));
    return;
  }
  if (is_gap) handover_.clock_step.Begin({before.stamp, first}, before.state.T_map_imu);
  const HistoryOptions options = HistoryOptionsAt(first);
  const double unknown_s = is_gap ? jump_s : UnknownAtSetClock_s(segment.step, jump_s);
  Estimate estimate = Coasted(before, unknown_s, options);
  context_.outputs.Notify(
      first, Notice::Severity::kWarning,
      fmt::format("the IMU's stamps jumped by {:.3f} s: the state is carried over; look for lost "
                  "messages or a clock that was set",
                  jump_s));
  if (is_gap) {
    if (health_.AddGap(first)) NotifyLost(first, context_.outputs);
  } else {
    estimate.state = before.state;
    const Duration by = Duration::FromSeconds(jump_s - unknown_s);
    handover_.ShiftTimesBy(by);
    health_.ShiftTimesBy(by);
    context_.clocks.Interrupt();
  }
  estimate.stamp = first;
  history_ = FilterHistory(options, estimate, segment.first);
}

// A clock that was set back by seconds, or another recording: the body is where it was, or anywhere
// that it reaches in as long a time.
void Tracking::SeekAfterSetBack(Estimate before, const SegmentStarts& segment) {
  const Duration back = before.stamp - segment.first.stamp;
  const Duration by = -(back + back);  // stamps from before then lie as far before the first one
  before.stamp = before.stamp + by;
  handover_.ShiftTimesBy(by);
  health_.ShiftTimesBy(by);
  SeekAfterOutage(before, segment,
                  fmt::format("the clocks were set back by {:.3f} s, or another recording begins",
                              back.Seconds()));
}

void Tracking::TakeClockStep(const AmbiguousClockStep& step) {
  handover_.clock_step.Begin(step.stamps);
}

std::optional<Pose> Tracking::PoseIfClockSet(const Sweep& sweep,
                                             const Pose& T_map_imu_predicted) const {
  return handover_.clock_step.PoseIfSet(sweep, T_map_imu_predicted, handover_.last_located,
                                        history_);
}

void Tracking::SettleClockStep(const MatchOutcome& outcome) {
  const std::optional<ClockStep> step = handover_.clock_step.Settle(outcome);
  if (!step || outage_.is_running()) return;
  ++context_.counters.num_clock_jumps;
  context_.outputs.Notify(
      outcome.sweep->end, Notice::Severity::kWarning,
      fmt::format("stamps of all sensors went forth by {:.3f} s but nothing moved meanwhile: the "
                  "clock was set, and the state is carried over",
                  SecondsBetween(step->before, step->after)));
}

}  // namespace lio
