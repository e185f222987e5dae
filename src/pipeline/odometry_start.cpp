// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "lio/filter/preintegration.hpp"
#include "pipeline/odometry_impl.hpp"

namespace lio {
namespace {

constexpr double kMovedDistance_m = 0.05;  // more than scan matching errs over a second ...
// ... but where the inertial data is as calm as at rest, traffic and bare ground may deceive it by
// more, and a vehicle that moves without shaking at all is fast.
constexpr double kMovedDistanceCalm_m = 0.5;
constexpr VibrationLevel kVeryCalm{0.005, 0.05};
constexpr double kMovedAngle_rad = 0.01;
constexpr double kMaxRestWait_s = 1.4;  // shaken, but not moved for this long, counts as rest
constexpr double kWaitNoticeEvery_s = 1.0;
// A start in motion looks back this far at most; the inertial buffer holds more.
constexpr double kMaxWindow_s = 3.5;
// Of the first scans nothing is known of the motion, and they are skewed: after this many it is,
// and they are matched anew.
constexpr std::size_t kMinGlance = 4;
constexpr std::size_t kMaxGlance = 8;
// Where after so many scans no velocity is clear, they start from rest.
constexpr std::size_t kMaxSought = 8;
constexpr double kGlanceVelocityStd_mps = 1.0;
constexpr int kUnmatchedWhenLost = 25;  // scans in a row
// A scan whose place in the map is less sure would blur the map.
constexpr double kMaxInsertStd_m = 0.3;

// Of three errors that belong together.
double LargestStd(const Estimate& estimate, int at) {
  return std::sqrt(estimate.cov.diagonal().segment<3>(at).maxCoeff());
}

// Roughly up, in whatever unit and sign forces come. Where gravity is not in them they point
// anywhere: then along the lidar's axis.
Vector3 MeanUp(std::span<const ImuSample> samples, const Rig& rig) {
  constexpr double kMaxLean = 0.7;  // cosine
  const Vector3 axis = rig.T_imu_lidar.value_or(Pose{}).rotation * Vector3::UnitZ();
  if (samples.empty()) return axis;
  const Vector3 up = Summarise(samples).mean_f_mps2.normalized();
  return std::abs(up.dot(axis)) > kMaxLean ? up : axis;
}

template <class... Args>
std::string Text(const char* format, Args... args) {
  char text[240];
  std::snprintf(text, sizeof text, format, args...);
  return text;
}

}  // namespace

std::vector<ImuSample> Odometry::Impl::SamplesBetween(Timestamp from, Timestamp to) const {
  std::vector<ImuSample> samples;
  for (const ImuSample& sample : imu_) {
    if (sample.stamp >= from && sample.stamp <= to) samples.push_back(sample);
  }
  return samples;
}

void Odometry::Impl::BeginScouting(const Sweep& sweep) {
  last_found_.reset();
  TrackerOptions scouting;
  scouting.span_s = options_.filter.history_s;
  scouting.nis_limit = nis_limit_;
  scouting.sought_v_imu_mps = sought_v_imu_mps_;
  scouting.motion = glance_;
  const Timestamp start = glance_ ? sweep.start : sweep.middle();
  if (use_imu_ && scouts_with_gyro_ && !imu_.empty()) {
    scouting.first_rate_radps = SampleAt(imu_, start).w_imu_radps;
  }
  const bool runs_by_lidar = phase_ == Phase::kRunning;
  if (runs_by_lidar && loss_) GoOnFromLoss(start, scouting);
  scout_.emplace(start, scouting);
  if (runs_by_lidar) {
    last_fix_ = MakeFix(start, history().head());
  }
  classifier_.BeginMap(sweep.start);
  scout_up_map_ = scouting.T_world_start.rotation *
                  MeanUp(SamplesBetween(sweep.start, sweep.end), options_.rig);
}

Vector3 Odometry::Impl::UpInMap(const NavState& state) const {
  if (scout_) return scout_up_map_;
  return state.T_map_imu.rotation * (state.T_world_imu.rotation.conjugate() * Vector3::UnitZ());
}

void Odometry::Impl::AdvanceScout(Timestamp stamp) {
  for (const ImuSample& sample : imu_) {
    if (sample.stamp <= stamp) scout_->AddRate(sample);
  }
  scout_->AdvanceTo(stamp);
}

// Of the first scans it is only sought how fast they were taken; then they are matched.
void Odometry::Impl::FinishSeeking(const MatchOutcome& outcome) {
  scouted_.push_back({{outcome.sweep->middle(), outcome.match.T_map_imu, Matrix6::Zero()}, false});
  if (!outcome.v_map_imu_mps && scouted_.size() < kMaxSought && !IsLastScouted()) return;
  sought_v_imu_mps_ = outcome.v_map_imu_mps;  // the map's axes are those of the first sweep
  has_sought_ = true;
  scouted_.clear();
}

void Odometry::Impl::FinishScouting(const MatchOutcome& outcome, InsertTask& insert) {
  if (!has_sought_) {
    FinishSeeking(outcome);
    return;
  }
  const Timestamp middle = outcome.sweep->middle();
  const bool is_matched = outcome.match.IsUsable();
  scout_->Tell(middle, outcome.match);
  const Estimate estimate = history().At(middle);
  const NavState& state = estimate.state;
  if (LargestStd(estimate, kMapPose) < kMaxInsertStd_m) insert.T_map_imu = state.T_map_imu;
  scouted_.push_back(
      {{middle, is_matched ? outcome.match.T_map_imu : state.T_map_imu, outcome.match.cov},
       is_matched});
  if (is_matched) TellClassifier({middle, outcome.match.T_map_imu});
  last_found_ = middle;
  if (!scouting_since_) scouting_since_ = outcome.sweep->start;
  if (!glance_ && scouted_.size() >= kMinGlance &&
      HasMovedSince(0, use_imu_ && IsVeryCalm(outcome.sweep->end)) &&
      LargestStd(estimate, kVel) < kGlanceVelocityStd_mps) {
    glance_ = state;
    scouted_.clear();
    if (!use_imu_) RunLidarOnly();
    return;
  }
  if (!use_imu_) {
    if (scouted_.size() >= kMaxGlance || IsLastScouted()) RunLidarOnly();
    return;
  }
  if (!JudgeWhileScouting(outcome.sweep->end)) TryStart(outcome.sweep->end);
}

void Odometry::Impl::BeginScoutingAnew() {
  scout_.reset();
  scouted_.clear();
  glance_.reset();
  has_sought_ = false;
  sought_v_imu_mps_.reset();
}

bool Odometry::Impl::HasMovedSince(std::size_t first, bool is_calm) const {
  const Pose motion = scouted_[first].pose.T_any_imu.Inverse() * scouted_.back().pose.T_any_imu;
  const double distance_m = motion.translation.norm();
  if (is_calm) return distance_m > kMovedDistanceCalm_m;
  return distance_m > kMovedDistance_m || LogSo3(motion.rotation).norm() > kMovedAngle_rad;
}

bool Odometry::Impl::IsVeryCalm(Timestamp stamp) const {
  const ImuStatistics statistics =
      Summarise(SamplesBetween(stamp - Duration::FromSeconds(options_.start.rest_s), stamp));
  return statistics.num_samples >= 3 && IsCalm(statistics, options_.rig.imu, kVeryCalm);
}

void Odometry::Impl::SayWaiting(Timestamp stamp, const std::string& text) {
  if (SecondsBetween(last_wait_notice_, stamp) < kWaitNoticeEvery_s) return;
  last_wait_notice_ = stamp;
  Say(stamp, Notice::Severity::kInfo, text);
}

void Odometry::Impl::TryStart(Timestamp stamp) {
  if (IsInDoubt(stamp)) {
    SayWaiting(stamp, "in doubt of the inertial unit's units and axes: waiting for turns");
  } else {
    TryStartAsItMoves(stamp);
  }
  const bool still_waits = phase_ == Phase::kScouting && !scouted_.empty();
  if (still_waits && SecondsBetween(ready_.front()->start, stamp) > kMaxWindow_s) {
    ForgetOldestScouted();
  }
}

void Odometry::Impl::TryStartAsItMoves(Timestamp stamp) {
  const bool is_calm = IsVeryCalm(stamp);
  std::size_t first_at_rest = scouted_.size() - 1;
  while (first_at_rest > 0 && !HasMovedSince(first_at_rest - 1, is_calm)) --first_at_rest;
  const Timestamp rest_begin = ready_[first_at_rest]->start;
  if (SecondsBetween(rest_begin, stamp) >= options_.start.rest_s &&
      scouted_.size() - first_at_rest >= 3) {
    TryStartAtRest(rest_begin, stamp);
  } else if (first_at_rest > 0) {
    TryStartInMotion(stamp);
  }
}

void Odometry::Impl::TryStartAtRest(Timestamp begin, Timestamp stamp) {
  const std::vector<ImuSample> samples = SamplesBetween(begin, stamp);
  if (samples.size() < 3) return;
  const ImuStatistics statistics = Summarise(samples);
  const bool is_calm = statistics.gyro_std_radps < options_.start.max_gyro_std_radps &&
                       statistics.accel_std_mps2 < options_.start.max_accel_std_mps2;
  if (is_calm || SecondsBetween(begin, stamp) >= kMaxRestWait_s) {
    if (!AcceptForceAtRest(statistics.mean_f_mps2, stamp)) return;
    if (!AcceptRatesAtRest(samples, stamp)) return;
    const std::size_t last = scouted_.size() - 1;
    StartFrom(StartAtRest(samples, ready_[last]->start, options_.rig), last);
    standstill_.BeginAtRest();
    return;
  }
  SayWaiting(stamp,
             Text("waiting for rest: gyro spread %.4f rad/s (limit %.4f), accel %.3f m/s^2 (%.3f)",
                  statistics.gyro_std_radps, options_.start.max_gyro_std_radps,
                  statistics.accel_std_mps2, options_.start.max_accel_std_mps2));
}

void Odometry::Impl::ForgetOldestScouted() {
  ready_.pop_front();
  scouted_.erase(scouted_.begin());
}

void Odometry::Impl::TryStartInMotion(Timestamp stamp) {
  const Timestamp begin = ready_.front()->start;
  if (SecondsBetween(begin, stamp) < options_.start.moving_window_s) return;
  const double waited_s = SecondsBetween(*scouting_since_, stamp);
  if (waited_s < options_.start.wait_for_rest_s) {
    SayWaiting(stamp, Text("in motion: waiting for rest, %.0f s more",
                           options_.start.wait_for_rest_s - waited_s));
    ForgetOldestScouted();
    return;
  }
  std::vector<MatchedPose> poses;
  for (const Scouted& scouted : scouted_) {
    if (scouted.is_matched) poses.push_back(scouted.pose);
  }
  const std::vector<ImuSample> samples(imu_.begin(), imu_.end());
  const Vector3 mean_f_mps2 = Summarise(SamplesBetween(begin, stamp)).mean_f_mps2;
  const std::optional<bool> has_gravity = GravityInMotion(mean_f_mps2);
  const std::string seen = Text("%.2f m/s^2 in the mean", mean_f_mps2.norm());
  MovingStart moving;
  if (!has_gravity) {
    moving.why_not = "the accelerometer reads " + seen + ": is it in g, or without gravity?";
  } else if (!AcceptGravity(*has_gravity, seen, stamp)) {
    return;
  } else {
    moving = StartMoving(samples, poses, begin, options_.rig, *has_gravity);
  }
  if (moving.start) {
    StartFrom(*moving.start, 0);
    return;
  }
  SayWaiting(stamp, "no start in motion yet: " + moving.why_not);
  if (SecondsBetween(begin, stamp) < kMaxWindow_s) return;
  // Perhaps the scout was misled by a gyro in wrong units or axes, or lost its way without one.
  scouts_with_gyro_ = !scouts_with_gyro_;
  ready_.erase(ready_.begin(), ready_.begin() + static_cast<std::ptrdiff_t>(scouted_.size()));
  BeginScoutingAnew();
}

// What the body has turned since, as far as its samples are still here.
void Odometry::Impl::TurnByGyro(const Estimate& now, LastFix& earlier) const {
  const std::vector<ImuSample> samples = SamplesBetween(earlier.stamp, now.stamp);
  if (samples.empty()) return;
  const Biases biases{now.state.gyro_bias, now.state.accel_bias};
  const Preintegration turn =
      Preintegrate(samples, samples.front().stamp, samples.back().stamp, biases, {});
  earlier.T_world_imu.rotation = earlier.T_world_imu.rotation * turn.rotation;
  earlier.T_map_imu.rotation = earlier.T_map_imu.rotation * turn.rotation;
}

void Odometry::Impl::ScoutAgain(Timestamp stamp, const std::string& why) {
  Say(stamp, Notice::Severity::kWarning, why);
  ++counters_.num_restarts;
  num_unmatched_in_a_row_ = 0;
  num_gated_in_a_row_ = 0;
  phase_ = Phase::kScouting;
  status_ = TrackingStatus::kInit;
  BeginScoutingAnew();
}

// In the world that was published, from the last pose that was found.
void Odometry::Impl::StartAnew(Timestamp stamp, const std::string& why) {
  resumption_ = {T_world_start_, T_map_start_, last_fix_, false};
  history_.reset();
  standstill_.Forget();
  last_standstill_.reset();
  ScoutAgain(stamp, why);
}

// Scans that see enough and are found nowhere, for seconds: the state is wrong by more than
// matching can mend.
void Odometry::Impl::StartAnewWhenLost(Timestamp stamp) {
  if (!history_ || num_unmatched_in_a_row_ < kUnmatchedWhenLost) return;
  StartAnew(stamp, "lost among things to see: the start begins anew");
}

LastFix Odometry::Impl::MakeFix(Timestamp stamp, const Estimate& estimate) const {
  const WorldEstimate published = InPublishedWorld(estimate);
  return {stamp, published.T_world_imu, published.v_world_imu, estimate.state.T_map_imu,
          published.cov.topLeftCorner<6, 6>()};
}

void Odometry::Impl::StartFrom(StartState start, std::size_t first_sweep) {
  const NavState& state = start.estimate.state;
  g_world_ = start.g_world;
  if (resumption_) {
    LastFix& fix = resumption_->last_fix;
    TurnByGyro(start.estimate, fix);
    const bool has_gravity = !g_world_.isZero();
    if (resumption_->is_by_lidar && has_gravity) Level(state.T_world_imu.rotation, fix);
    PlaceInWorld(fix, has_gravity, start.estimate);
    resumption_.reset();
  }
  T_world_start_ = state.T_world_imu;
  T_map_start_ = state.T_map_imu;
  last_fix_ = MakeFix(start.estimate.stamp, start.estimate);
  classifier_.BeginMap(start.estimate.stamp);
  ready_.erase(ready_.begin(), ready_.begin() + static_cast<std::ptrdiff_t>(first_sweep));
  BeginScoutingAnew();
  scouting_since_.reset();
  history_.emplace(MakeHistoryOptions(), start.estimate, SampleAt(imu_, start.estimate.stamp));
  history_->KeepFrom(start.estimate.stamp - ClockMargin());
  for (const ImuSample& sample : imu_) {
    if (sample.stamp > start.estimate.stamp) (void)history_->AddImu(sample);
  }
  phase_ = Phase::kRunning;
  is_first_scan_ = true;
  gated_scans_ = 0;
  keyframes_.Reset();
  last_fused_ = start.estimate.stamp;
  status_ = TrackingStatus::kOk;
  const std::string read_as = reading_ == ImuConvention{} ? "" : "; " + Describe(reading_);
  Say(start.estimate.stamp, Notice::Severity::kInfo, start.how + read_as);
}

}  // namespace lio
