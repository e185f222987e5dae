// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/mode_driver.hpp"

#include <utility>
#include <variant>

#include "pipeline/health.hpp"

namespace lio {
namespace {

MatchJob MakeJobOf(auto& mode, const SweepPtr& sweep) {
  return mode.MakeJob(sweep);
}
MatchJob MakeJobOf(Rejected& /*mode*/, const SweepPtr& /*sweep*/) {
  return {};
}

std::optional<Transition> FinishJobOf(auto& mode, const MatchOutcome& outcome, InsertTask& insert) {
  return mode.FinishJob(outcome, insert);
}
std::optional<Transition> FinishJobOf(Rejected& /*mode*/, const MatchOutcome& /*outcome*/,
                                      InsertTask& /*insert*/) {
  return std::nullopt;
}

}  // namespace

ModeDriver::ModeDriver(const ModeContext& context, PlaceKnowledge& place, const Handover& handover)
    : context_(context),
      place_(place),
      mode_(std::make_unique<Mode>(Initializing(context_, handover))) {
  context_.outputs.Mute(place_.is_seeking());
}

void ModeDriver::Consume(const StreamEvent& event) {
  GoOn(std::visit([&](const auto& content) { return Take(content); }, event));
}

MatchJob ModeDriver::MakeJob(const SweepPtr& sweep) {
  MatchJob job = std::visit([&](auto& mode) { return MakeJobOf(mode, sweep); }, *mode_);
  place_.Prepare(kind() == ModeKind::kTracking, job);
  context_.outputs.Mute(place_.is_seeking());
  job.T_imu_lidar = context_.extrinsic.T_imu_lidar();
  return job;
}

InsertTask ModeDriver::FinishJob(const MatchOutcome& outcome) {
  InsertTask insert;
  const bool has_sought = place_.is_seeking() && kind() == ModeKind::kTracking;
  GoOn(std::visit([&](auto& mode) { return FinishJobOf(mode, outcome, insert); }, *mode_));
  if (has_sought) TakePlace(outcome);
  if (place_.is_map_locked()) insert.T_map_imu.reset();
  return insert;
}

TrackingStatus ModeDriver::status() const {
  return place_.is_seeking() ? Health::StatusWhileSeeking(place_.was_inside()) : StatusOf(*mode_);
}

// Changes the mode where that is asked for.
void ModeDriver::GoOn(Next transition) {
  if (transition) {
    mode_ = std::make_unique<Mode>(BuildNext(*mode_, std::move(*transition), context_));
  }
  const auto* tracking = As<Tracking>();
  context_.stream.SetBegin(tracking ? std::optional(tracking->begin()) : std::nullopt);
  if (transition && kind() == ModeKind::kRejected) {
    context_.ForgetSweeps(context_.sweeps.size());
    context_.stream.Reject();
  }
}

void ModeDriver::TakePlace(const MatchOutcome& outcome) {
  auto* tracking = As<Tracking>();
  if (tracking == nullptr) return;
  if (!outcome.place) {
    context_.outputs.NotifyWaiting(outcome.sweep->end,
                                   "the place in the initial map is being sought; if it is not "
                                   "found while the body moves, check that the map is of this "
                                   "place with z up, or say where to seek by --initial-pose");
    return;
  }
  place_.SetFound();
  context_.outputs.Mute(false);
  tracking->EnterMap(*outcome.place, *outcome.sweep);
}

ModeDriver::Next ModeDriver::Take(const ImuReady& event) {
  if (auto* tracking = As<Tracking>()) tracking->AddImu(event);
  return std::nullopt;
}

ModeDriver::Next ModeDriver::Take(const SweepReady& event) {
  auto* tracking = As<Tracking>();
  if (tracking && context_.sweeps.empty()) tracking->AddSweep(*event.sweep);
  context_.sweeps.push_back(event.sweep);
  if (As<Initializing>() && context_.sweeps.size() == 1 &&
      !Initializing::MayBeginWith(*event.sweep)) {
    context_.ForgetSweeps(1);
  }
  context_.examiner.tally().AddSweep(event.sweep->end);
  return std::nullopt;
}

ModeDriver::Next ModeDriver::Take(const SegmentStarts& event) {
  if (auto* tracking = As<Tracking>()) {
    (void)TakeRule(ModeKind::kTracking, Trigger::kSegmentStarts, context_.counters);
    tracking->StartSegment(event);
    return std::nullopt;
  }
  if (auto* lidar_only = As<LidarOnly>()) lidar_only->StartSegment(event);
  if (auto* initializing = As<Initializing>()) return initializing->StartSegment(event);
  return std::nullopt;
}

ModeDriver::Next ModeDriver::Take(const AmbiguousClockStep& event) {
  if (auto* tracking = As<Tracking>()) tracking->TakeClockStep(event);
  if (auto* initializing = As<Initializing>()) initializing->TakeClockStep(event);
  return std::nullopt;
}

ModeDriver::Next ModeDriver::Take(const ImuAbsent& event) {
  context_.clocks.Stop();
  context_.outputs.Notify(event.stamp, Notice::Severity::kWarning,
                          event.evidence +
                              ": lidar-only odometry until they do; look at the IMU's "
                              "driver, or set pipeline.use_imu to false");
  if (const auto* tracking = As<Tracking>()) return tracking->TakeImuAbsent(event);
  if (auto* lidar_only = As<LidarOnly>()) lidar_only->TakeImuAbsent();
  const auto* initializing = As<Initializing>();
  return initializing ? initializing->TakeImuAbsent() : std::nullopt;
}

ModeDriver::Next ModeDriver::Take(const ImuAppeared& event) {
  context_.ForgetSweeps(context_.sweeps.size());
  context_.clocks.Resume();
  if (auto* lidar_only = As<LidarOnly>()) return lidar_only->TakeImu(event);
  if (auto* initializing = As<Initializing>()) return initializing->TakeImu(event);
  return std::nullopt;
}

ModeDriver::Next ModeDriver::Take(const StreamEnded& /*event*/) {
  auto* initializing = As<Initializing>();
  return initializing ? initializing->EndStream() : std::nullopt;
}

ModeDriver::Next ModeDriver::Take(const Notice& notice) {
  if (notice.severity == Notice::Severity::kInfo) {
    context_.outputs.NotifyWaiting(notice.stamp, notice.text);
  } else {
    context_.outputs.Add(notice);
  }
  return std::nullopt;
}

}  // namespace lio
