// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "pipeline/odometry_impl.hpp"

namespace lio {
namespace {

constexpr int kUnmatchedWhenLost = 5;  // coasting on is wrong by more with each scan
constexpr int kYoungScans = 10;        // with fewer a map is thin, and its cells are of no shape
constexpr double kTurnLasts_s = 0.5;   // of a body that is not seen
constexpr Duration kImuIsThere{500'000'000};

}  // namespace

// From the first sweep on, along the motion that was glanced.
void Odometry::Impl::RunLidarOnly() {
  scouted_.clear();
  scout_.reset();
  phase_ = Phase::kRunning;
  is_first_scan_ = true;
  num_scans_in_map_ = 0;
  keyframes_.Reset();
}

bool Odometry::Impl::IsMapYoung() const {
  return !use_imu_ && phase_ == Phase::kRunning && num_scans_in_map_ < kYoungScans;
}

// A scan grows the map where its place is beyond doubt: in the first one that was found after some
// that were not, it is not yet.
bool Odometry::Impl::IsPlaceSure(const MatchOutcome& outcome) const {
  return num_unmatched_in_a_row_ == 0 && !outcome.is_relocalized;
}

// Without an inertial unit a path that was lost goes on straight, wherever that leads: better on a
// new map, in the world that was published.
void Odometry::Impl::StartAnewByLidar(Timestamp stamp) {
  if (num_unmatched_in_a_row_ < kUnmatchedWhenLost) return;
  const Estimate estimate = scout_->history().At(stamp);
  loss_ = {last_fix_, -estimate.state.gyro_bias, estimate.cov.topLeftCorner<6, 6>()};
  ScoutAgain(stamp,
             "lost among things to see: the map begins anew, from the last pose that was found");
}

// Where the new map begins, by the motion before and after what was not seen.
void Odometry::Impl::GoOnFromLoss(Timestamp stamp, TrackerOptions& scouting) {
  const LastFix& fix = loss_->last_fix;
  const double since_s = CoastedSince_s(fix, stamp);
  const Vector3 turn = std::min(since_s, kTurnLasts_s) * loss_->w_imu_radps;
  const Quaternion rotation = fix.T_world_imu.rotation * ExpSo3(turn);
  Vector3 v_world_mps = fix.v_world_imu;
  if (glance_) {
    const Vector3 v_imu_mps = glance_->T_world_imu.rotation.conjugate() * glance_->v_world_imu;
    v_world_mps = 0.5 * (v_world_mps + rotation * v_imu_mps);
  }
  scouting.T_world_start = {rotation, fix.T_world_imu.translation + since_s * v_world_mps};
  Vector6 least;
  least << Vector3::Constant(kPlacedStd_m * kPlacedStd_m),
      Vector3::Constant(kPlacedStd_rad * kPlacedStd_rad);
  scouting.start_cov = loss_->pose_cov;
  scouting.start_cov.diagonal() += least;
  loss_.reset();
}

// An inertial unit that comes up after the lidar. A stray sample is none, nor is one by another
// clock of use.
void Odometry::Impl::TakeLateImu(const ImuSample& sample) {
  const ImuPreprocessor::Result result = intake_.Add(sample);
  if (result.step != ImuPreprocessor::Step::kNone) late_imu_.clear();
  for (const ImuSample& accepted : result.accepted) {
    const bool is_apart = TellIfClocksApart(accepted.stamp, newest_chunk_);
    if (is_apart) late_imu_.clear();
    if (is_apart || (!late_imu_.empty() && accepted.stamp <= late_imu_.back().stamp)) {
      ++counters_.num_imu_late;
      continue;
    }
    late_imu_.push_back(accepted);
  }
  if (late_imu_.empty()) return;
  const Duration span = late_imu_.back().stamp - late_imu_.front().stamp;
  if (span < kImuIsThere) return;
  new_stretch_.accepted = std::exchange(late_imu_, {});
  new_stretch_.step = ImuPreprocessor::Step::kGap;
  if (!HasWork()) ResumeAfterStretch();
}

// The lidar's path ends, and with the inertial unit the start begins anew from there.
void Odometry::Impl::GoInertial(Timestamp first) {
  use_imu_ = true;
  if (phase_ == Phase::kRunning || loss_) {
    resumption_ = {T_world_start_, T_map_start_, loss_ ? loss_->last_fix : last_fix_, true};
    is_map_by_lidar_ = true;
  }
  loss_.reset();
  ready_.clear();
  gate_.BeginNewStretch(first);
  scouting_since_.reset();
  if (options_.filter.estimate_clock_offset) clock_offset_.emplace(options_.rig.imu);
  ScoutAgain(first, "inertial samples have come: the start begins anew, with them");
}

}  // namespace lio
