// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/initializing.hpp"

#include <cmath>
#include <utility>

#include "lio/filter/sample_lookup.hpp"
#include "lio/imu/initialization_parameters.hpp"
#include "lio/imu/rest_force.hpp"
#include "pipeline/coarse_tracking.hpp"

namespace lio {
namespace {

// Returns the largest of three standard deviations that belong together.
double LargestStd(const Estimate& estimate, int at) {
  return std::sqrt(estimate.cov.diagonal().segment<3>(at).maxCoeff());
}

}  // namespace

Initializing::Initializing(const ModeContext& context, Handover handover,
                           std::optional<Timestamp> since)
    : context_(context), handover_(std::move(handover)), since_(since) {}

MatchJob Initializing::MakeJob(const SweepPtr& sweep) {
  const bool is_first = scans_.empty();
  if (is_first) {
    BeginTrack(*sweep);
  } else {
    FollowClockBack(*sweep, *tracker_, handover_.last_located);
  }
  for (const ImuSample& sample : context_.stream.imu().samples()) {
    if (sample.stamp <= sweep->end) tracker_->AddRate(sample);
  }
  tracker_->AdvanceTo(sweep->end);
  MatchJob job = MakeCoarseJob(sweep, *tracker_, handover_.last_located, up_map_);
  if (is_first) job.map_action = MapAction::kClear;
  if (!has_velocity_seed_) job.task = FindVelocity{};
  return job;
}

void Initializing::BeginTrack(const Sweep& sweep) {
  handover_.last_located.reset();
  const ImuBuffer& imu = context_.stream.imu();
  TrackerOptions options;
  options.span_s = context_.options.filter.history_s;
  options.nis_limit = context_.nis_limit;
  options.seed = seed_;
  const Timestamp start = TrackStart(sweep, seed_);
  if (HasImu() && context_.convention.trusts_gyro() && !imu.samples().empty()) {
    options.first_rate_radps = SampleAt(imu.samples(), start).w_imu_radps;
  }
  tracker_.emplace(start, options);
  context_.convention.BeginMap(sweep.start);
  up_map_ = options.T_world_start.rotation *
            MeanUp(imu.Between(sweep.start, sweep.end), context_.options.rig);
}

std::optional<Transition> Initializing::FinishJob(const MatchOutcome& outcome, InsertTask& insert) {
  if (!has_velocity_seed_) {
    FinishVelocitySearch(outcome);
    return std::nullopt;
  }
  AddScan(outcome, insert);
  const Timestamp end = outcome.sweep->end;
  const Estimate estimate = tracker_->history().At(outcome.sweep->middle());
  const bool has_imu = HasImu();
  if (IsMotionKnown(end, estimate)) {
    seed_.motion = estimate.state;
    if (!has_imu) return TryLidarOnly(end);
    scans_.clear();
    return std::nullopt;
  }
  if (!has_imu) {
    const bool is_enough = scans_.size() >= kInitializing.max_scans_for_motion || IsLastScan();
    return is_enough ? std::optional(TryLidarOnly(end)) : std::nullopt;
  }
  if (auto transition = JudgeConvention(end)) return transition;
  return TryStart(end);
}

// The first scans only tell how fast they were taken; then they are matched.
void Initializing::FinishVelocitySearch(const MatchOutcome& outcome) {
  scans_.push_back({{outcome.sweep->middle(), outcome.match.T_map_imu, Matrix6::Zero()}, false});
  if (!outcome.v_map_imu_mps && scans_.size() < kInitializing.max_scans_for_velocity &&
      !IsLastScan()) {
    return;
  }
  seed_.v_imu_mps = outcome.v_map_imu_mps;  // the map's axes are those of the first sweep
  by_buildings_ = {outcome.sweep->middle(), outcome.speed_by_buildings};
  has_velocity_seed_ = true;
  scans_.clear();
}

void Initializing::AddScan(const MatchOutcome& outcome, InsertTask& insert) {
  const Timestamp middle = outcome.sweep->middle();
  const Matrix6 match_cov = tracker_->MatchCov(middle, outcome.match);
  const bool is_fused = tracker_->AddMatch(middle, outcome.match);
  const bool is_matched = is_fused && outcome.match.IsUsable();
  const Estimate estimate = tracker_->history().At(middle);
  const NavState& state = estimate.state;
  if (LargestStd(estimate, kMapPose) < kInitializing.max_insert_std_m) {
    insert.T_map_imu = state.T_map_imu;
  }
  const MatchedPose predicted{middle, state.T_map_imu,
                              estimate.cov.block<6, 6>(kMapPose, kMapPose)};
  const MatchedPose matched{middle, outcome.match.T_map_imu, match_cov};
  scans_.push_back({is_matched ? matched : predicted, is_matched});
  if (is_matched && HasImu()) {
    context_.convention.AddPose({middle, outcome.match.T_map_imu});
  }
  if (is_fused) handover_.last_located = middle;
  if (!since_) since_ = outcome.sweep->start;
}

// Known for the first time: then the scans are matched again.
bool Initializing::IsMotionKnown(Timestamp sweep_end, const Estimate& estimate) const {
  return !seed_.motion && scans_.size() >= kInitializing.min_scans_for_motion &&
         HasMovedSince(0, HasImu() ? CalmOf(sweep_end) : Calm::kShaken) &&
         LargestStd(estimate, kVel) < kInitializing.motion_velocity_std_mps;
}

bool Initializing::IsLastScan() const {
  return context_.stream.is_flushed() && scans_.size() == context_.sweeps.size();
}

bool Initializing::HasMovedSince(std::size_t first, Calm calm) const {
  const MatchedPose& then = scans_[first].pose;
  const MatchedPose& now = scans_.back().pose;
  // Scans that matched nothing show nothing of a body that turns.
  const bool sees = scans_.back().is_matched && (first == 0 || scans_[first].is_matched);
  if (calm == Calm::kSways && !sees) calm = Calm::kShaken;
  switch (calm) {
    case Calm::kStill:
      return ShownBetween(then, now).shift_m > kRest.at_start.max_shift_calm_m;
    case Calm::kSways:
      return ShownBetween(then, now).shift_m > kRest.at_start.max_shift_m;
    case Calm::kShaken:
      break;
  }
  const Pose motion = then.T_any_imu.Inverse() * now.T_any_imu;
  return motion.translation.norm() > kRest.at_start.max_shift_m ||
         LogSo3(motion.rotation).norm() > kRest.at_start.max_turn_rad;
}

// A body that turns steadily does not shake either, but its rate is beyond a gyro's bias.
Initializing::Calm Initializing::CalmOf(Timestamp stamp) const {
  const ImuRig& imu = context_.options.rig.imu;
  const Timestamp begin = stamp - Duration::FromSeconds(context_.options.start.rest_s);
  const std::vector<ImuSample> samples = context_.stream.imu().Between(begin, stamp);
  ImuStatistics statistics = Summarise(samples);
  if (statistics.num_samples < kInitializing.min_samples_at_rest) return Calm::kShaken;
  const double max_rate_radps =
      kInitializationParameters.in_motion.max_bias_sigmas * imu.gyro_bias_std_radps;
  if (statistics.mean_w_radps.cwiseAbs().maxCoeff() < max_rate_radps &&
      IsCalm(statistics, imu, kRest.at_start.calm)) {
    return Calm::kStill;
  }
  statistics.gyro_std_radps = 0.0;
  statistics.accel_std_mps2 = SpreadOfTurnedForce(samples);
  return IsCalm(statistics, imu, kRest.at_start.calm) ? Calm::kSways : Calm::kShaken;
}

void Initializing::ForgetOldestScan() {
  context_.ForgetSweeps(1);
  scans_.erase(scans_.begin());
}

Transition Initializing::StartSegment(const SegmentStarts& segment) {
  Handover handover = handover_;
  if (segment.last_imu && segment.step != ImuPreprocessor::Step::kGap) {
    handover.ShiftTimesBy(segment.first.stamp - *segment.last_imu);
    context_.clocks.Interrupt();
  }
  context_.ForgetSweeps(context_.sweeps.size());
  context_.outputs.Notify(segment.first.stamp, Notice::Severity::kWarning,
                          "the IMU's stamps jumped: initialization begins again; look for lost "
                          "messages or a clock that was set");
  return {.trigger = Trigger::kSegmentStarts, .handover = std::move(handover)};
}

std::optional<Transition> Initializing::TakeImuAbsent() const {
  return tracker_ ? std::optional(Retry()) : std::nullopt;
}

Transition Initializing::TakeImu(const ImuAppeared& event) {
  context_.outputs.Notify(event.first, Notice::Severity::kWarning,
                          "inertial samples have come: initialization begins again, with them, and "
                          "nothing need be done");
  Handover handover = handover_;
  handover.BelieveImu();
  if (handover.origin == Handover::Origin::kLostLidar) {
    handover.origin = Handover::Origin::kLidar;
    handover.is_map_by_lidar = true;
  }
  return {.trigger = Trigger::kImuAppeared, .handover = std::move(handover)};
}

std::optional<Transition> Initializing::EndStream() {
  if (HasImu() || !IsLastScan()) return std::nullopt;
  return GoLidarOnly();
}

void Initializing::TakeClockStep(const AmbiguousClockStep& step) {
  handover_.clock_step.Begin(step.stamps);
}

Transition Initializing::Retry() const {
  return {.trigger = Trigger::kRetry, .handover = handover_, .initializing_since = since_};
}

Transition Initializing::TryLidarOnly(Timestamp stamp) {
  return MayFollowTraffic(stamp, false) ? RetryWithNextSweep() : GoLidarOnly();
}

Transition Initializing::GoLidarOnly() const {
  return {.trigger = Trigger::kNoImu, .handover = handover_, .seed = seed_};
}

}  // namespace lio
