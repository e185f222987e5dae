// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tracking finds the way back from an outage.
#include <fmt/format.h>

#include "lio/filter/sample_lookup.hpp"
#include "pipeline/tracking.hpp"

namespace lio {

using OutageStage = OutageRecovery::Stage;

// Nothing is known of the motion until a scan tells.
void Tracking::SeekAfterOutage(const Estimate& before, const SegmentStarts& segment,
                               const std::string& why) {
  const Timestamp first = segment.first.stamp;
  handover_.clock_step.Begin({before.stamp, first}, before.state.T_map_imu);
  history_ = FilterHistory(LearnedOptionsAt(first), AcrossOutage(before, first), segment.first);
  outage_.Begin(before, before.state.T_map_imu);
  (void)health_.AddGap(first);
  context_.clocks.Interrupt();
  context_.outputs.Notify(first, Notice::Severity::kWarning,
                          fmt::format("lost: {}; scans tell whether the body has moved, and no "
                                      "pose is sure until they do; nothing need be done",
                                      why));
  if (outage_.stage() == OutageStage::kFindVelocity) LeaveMap(first);
}

void Tracking::BeginNewMap() {
  const Timestamp now = history_.start_stamp();  // not the newest sample: live more have come
  outage_.BeginNewMap(history_.At(now));
  (void)health_.AddGap(now);
  context_.clocks.Interrupt();
  LeaveMap(now);
}

// The place is sought as after an outage, from the pose that the inertial samples give, if no scan
// was matched for so long that matching cannot search all the poses that they leave.
void Tracking::SeekAfterSilence(Timestamp end) {
  if (outage_.is_running() || context_.place.is_inside() || IsPriorSure(end)) return;
  outage_.Begin(history_.At(end), handover_.last_fix.T_map_imu);
  if (outage_.stage() == OutageStage::kFindVelocity) LeaveMap(end);
}

void Tracking::TellLost(Timestamp end) {
  NotifyLost(end, context_.outputs);
  SeekAfterSilence(end);
}

void Tracking::AddScanAfterOutage(const MatchOutcome& outcome, bool is_fused) {
  using Event = OutageRecovery::Event;
  if (!outage_.is_running()) {
    if (is_fused) outage_.NoteMatch(outcome.match);
    return;
  }
  if (outage_.stage() == OutageStage::kFindVelocity && outcome.v_map_imu_mps) TakeVelocity(outcome);
  const Timestamp end = outcome.sweep->end;
  const Event event = outage_.AddScan(outcome, is_fused, outcome.num_used >= kHealth.min_points);
  if (event == Event::kConfirmed) NotifyFound(end);
  if (event == Event::kContradicted) BeginHistoryAt(AcrossOutage(outage_.before(), end));
  if (event == Event::kContradicted || event == Event::kFoundNowhere) LeaveMap(end);
}

// The velocity is given in the axes of the prior.
void Tracking::TakeVelocity(const MatchOutcome& outcome) {
  constexpr double kVar = kOutage.found_velocity_std_mps * kOutage.found_velocity_std_mps;
  const Vector3 v_imu_mps = outcome.match.T_map_imu.rotation.conjugate() * *outcome.v_map_imu_mps;
  if (history_.AddVelocity(outcome.sweep->middle(), v_imu_mps, kVar) != EventOutcome::kApplied) {
    ++context_.counters.num_scans_late;
  }
}

void Tracking::NotifyFound(Timestamp end) {
  const double moved_m = outage_.moved_m();
  const char* why = moved_m < kOutage.stayed_m ? ": the body stayed there, or clocks were set" : "";
  context_.outputs.Notify(
      end, Notice::Severity::kWarning,
      fmt::format("found again in the map, {:.1f} m from where it was{}; nothing need be done",
                  moved_m, why));
}

void Tracking::BeginHistoryAt(const Estimate& estimate) {
  const auto& samples = context_.stream.imu().samples();
  history_ =
      FilterHistory(LearnedOptionsAt(estimate.stamp), estimate, SampleAt(samples, estimate.stamp));
  history_.KeepFrom(estimate.stamp);
  AddSamplesAfter(estimate.stamp);
}

// Adds the samples that the stream has already. The history cannot refuse them: they rise, and it
// begins before them.
void Tracking::AddSamplesAfter(Timestamp stamp) {
  for (const ImuSample& sample : context_.stream.imu().samples()) {
    if (sample.stamp > stamp) (void)history_.AddImu(sample);
  }
}

// A yaw that the inertial samples have followed stays in the filter: velocities still tell of it.
void Tracking::SetYawAside(Timestamp stamp) {
  Estimate estimate = history_.At(stamp);
  if (MoveUnsureYaw(estimate, handover_.yaw_doubt)) BeginHistoryAt(estimate);
}

// The map is of no use any more: a new one begins with the next scans.
void Tracking::LeaveMap(Timestamp stamp) {
  handover_.clock_step.End();
  handover_.last_located.reset();
  keyframes_.Reset();
  context_.blind_axis.Reset();
  context_.convention.BeginMap(stamp);
  SetYawAside(stamp);
  context_.outputs.Notify(
      stamp, Notice::Severity::kWarning,
      "the place is not found in the map, so a new map begins in the same world; "
      "nothing need be done, the covariance says how sure its place there is");
}

}  // namespace lio
