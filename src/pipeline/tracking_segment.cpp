// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tracking goes on across gaps of the inertial stream and steps of its clock.
#include <fmt/format.h>

#include "pipeline/segment_jump.hpp"
#include "pipeline/tracking.hpp"

namespace lio {

void Tracking::StartSegment(const SegmentStarts& segment) {
  context_.ForgetSweeps(context_.sweeps.size());
  handover_.clock_step.End();
  handover_.last_published.reset();
  zero_velocity_.Forget();
  const Estimate before = history_.head();
  const SegmentJump jump = JudgeJump(before.stamp, segment);
  switch (jump.kind) {
    case SegmentJump::Kind::kSetFarBack:
      return SeekAfterSetBack(before, segment);
    case SegmentJump::Kind::kUnseen:
      return SeekAfterOutage(before, segment,
                             fmt::format("by their stamps nothing came of all sensors for {:.3f} "
                                         "s, or their clocks were set",
                                         jump.jump_s));
    case SegmentJump::Kind::kGap:
    case SegmentJump::Kind::kClockSet:
      return CarryOver(before, jump, segment.first);
  }
}

// The state goes on from where it was, unsure of what happened in between, at the new time.
void Tracking::CarryOver(const Estimate& before, const SegmentJump& jump, const ImuSample& sample) {
  const Timestamp first = sample.stamp;
  context_.outputs.Notify(
      first, Notice::Severity::kWarning,
      fmt::format("the IMU's stamps jumped by {:.3f} s: the state is carried over; look for lost "
                  "messages or a clock that was set",
                  jump.jump_s));
  const HistoryOptions options = LearnedOptionsAt(first);
  if (jump.kind == SegmentJump::Kind::kGap) {
    handover_.clock_step.Begin({before.stamp, first}, before.state.T_map_imu);
    if (health_.AddGap(first)) NotifyLost(first, context_.outputs);
  } else {
    handover_.ShiftTimesBy(jump.set_by());
    health_.ShiftTimesBy(jump.set_by());
    outage_.ShiftTimesBy(jump.set_by());
    context_.clocks.Interrupt();
  }
  history_ = FilterHistory(options, CarriedOver(before, jump, first, options), sample);
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
      fmt::format("stamps of all sensors went forward by {:.3f} s but nothing moved meanwhile: the "
                  "clock was set, and the state is carried over; nothing need be done",
                  SecondsBetween(step->before, step->after)));
}

}  // namespace lio
