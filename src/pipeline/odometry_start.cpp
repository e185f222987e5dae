// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>

#include "pipeline/odometry_impl.hpp"

namespace lio {
namespace {

constexpr double kMovedDistance_m = 0.05;  // more than scan matching errs over a second ...
// ... but where the inertial data is as calm as at rest, traffic and bare ground may deceive it by
// more, and a vehicle that moves without shaking at all is fast.
constexpr double kMovedDistanceCalm_m = 0.5;
constexpr double kCalmGyroStd_radps = 0.005;
constexpr double kCalmAccelStd_mps2 = 0.05;
constexpr double kMovedAngle_rad = 0.01;
constexpr double kMaxRestWait_s = 1.4;  // shaken, but not moved for this long, counts as rest
constexpr double kWaitNoticeEvery_s = 1.0;

}  // namespace

std::vector<ImuSample> Odometry::Impl::SamplesBetween(Timestamp from, Timestamp to) const {
  std::vector<ImuSample> samples;
  for (const ImuSample& sample : imu_) {
    if (sample.stamp >= from && sample.stamp <= to) samples.push_back(sample);
  }
  return samples;
}

ImuSample Odometry::Impl::SampleAt(Timestamp stamp) const {
  const auto after =
      std::lower_bound(imu_.begin(), imu_.end(), stamp,
                       [](const ImuSample& sample, Timestamp t) { return sample.stamp < t; });
  if (after == imu_.end()) return InterpolateSample(imu_.back(), imu_.back(), stamp);
  if (after == imu_.begin()) return InterpolateSample(*after, *after, stamp);
  return InterpolateSample(*std::prev(after), *after, stamp);
}

void Odometry::Impl::FinishScouting(const MatchOutcome& outcome, InsertTask& insert) {
  const Timestamp middle = outcome.sweep->middle();
  PoseEvent event;
  event.measurement.T_map_imu = outcome.match.T_map_imu;
  event.measurement.cov = outcome.match.cov;
  event.force = true;
  if (outcome.match.IsUsable()) {
    history().AddPose(middle, event);
  } else {
    history().AddRebase(middle);
  }
  const Pose T_map_imu = history().At(middle).state.T_map_imu;
  insert.T_map_imu = T_map_imu;
  scouted_.push_back({middle, T_map_imu});
  last_found_ = middle;
  TryStart(outcome.sweep->end);
}

bool Odometry::Impl::HasMoved(const ImuStatistics& statistics) const {
  const Pose motion = scouted_.front().pose.Inverse() * scouted_.back().pose;
  const double distance_m = motion.translation.norm();
  if (statistics.gyro_std_radps < kCalmGyroStd_radps &&
      statistics.accel_std_mps2 < kCalmAccelStd_mps2) {
    return distance_m > kMovedDistanceCalm_m;
  }
  return distance_m > kMovedDistance_m || LogSo3(motion.rotation).norm() > kMovedAngle_rad;
}

void Odometry::Impl::TryStart(Timestamp stamp) {
  const Timestamp first = ready_.front()->start;
  const double span_s = SecondsBetween(first, stamp);
  if (span_s < options_.start.rest_s || scouted_.size() < 3) return;
  const std::vector<ImuSample> samples = SamplesBetween(first, stamp);
  if (samples.size() < 3) return;
  const ImuStatistics statistics = Summarise(samples);
  if (HasMoved(statistics)) {
    // The scout begins with unknown velocity, so its first step is its worst: leave it out.
    const std::vector<ImuSample> all = SamplesBetween(imu_.front().stamp, stamp);
    StartState start = StartMoving(all, scouted_, options_.rig);
    CarryBack(start, ready_.front()->start);
    StartFrom(start, 0);
    return;
  }
  const bool is_calm = statistics.gyro_std_radps < options_.start.max_gyro_std_radps &&
                       statistics.accel_std_mps2 < options_.start.max_accel_std_mps2;
  if (is_calm || span_s >= kMaxRestWait_s) {
    StartFrom(StartAtRest(samples, ready_[scouted_.size() - 1]->start, options_.rig),
              scouted_.size() - 1);
    return;
  }
  if (SecondsBetween(last_wait_notice_, stamp) < kWaitNoticeEvery_s) return;
  last_wait_notice_ = stamp;
  char text[160];
  std::snprintf(text, sizeof text,
                "waiting for rest: gyro spread %.4f rad/s (limit %.4f), accel %.3f m/s^2 (%.3f)",
                statistics.gyro_std_radps, options_.start.max_gyro_std_radps,
                statistics.accel_std_mps2, options_.start.max_accel_std_mps2);
  Say(stamp, Notice::Severity::kInfo, text);
}

// The state at an earlier instant, by integrating backwards; the covariance is taken as it is, for
// a sweep's half.
void Odometry::Impl::CarryBack(StartState& start, Timestamp stamp) const {
  Estimate& estimate = start.estimate;
  std::vector<ImuSample> samples = SamplesBetween(stamp, estimate.stamp);
  samples.insert(samples.begin(), SampleAt(stamp));
  ImuSample from = SampleAt(estimate.stamp);
  for (auto sample = samples.rbegin(); sample != samples.rend(); ++sample) {
    estimate.state = PropagateState(estimate.state, from, *sample, start.g_world);
    from = *sample;
  }
  estimate.state.T_map_imu = estimate.state.T_world_imu;
  estimate.stamp = stamp;
}

void Odometry::Impl::StartFrom(const StartState& start, std::size_t first_sweep) {
  ready_.erase(ready_.begin(), ready_.begin() + static_cast<std::ptrdiff_t>(first_sweep));
  scout_.reset();
  scouted_.clear();
  g_world_ = start.g_world;
  const auto steady =
      start.in_motion ? SteadyWorld::Mode::kFromMotion : SteadyWorld::Mode::kFromRest;
  world_ = SteadyWorld(options_.filter.steady_world ? steady : SteadyWorld::Mode::kFollow);
  history_.emplace(MakeHistoryOptions(), start.estimate, SampleAt(start.estimate.stamp));
  for (const ImuSample& sample : imu_) {
    if (sample.stamp > start.estimate.stamp) history_->AddImu(sample);
  }
  phase_ = Phase::kRunning;
  is_first_scan_ = true;
  keyframes_.Reset();
  last_fused_ = start.estimate.stamp;
  status_ = TrackingStatus::kOk;
  Say(start.estimate.stamp, Notice::Severity::kInfo, start.how);
}

}  // namespace lio
