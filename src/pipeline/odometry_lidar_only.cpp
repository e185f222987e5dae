// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "pipeline/odometry_impl.hpp"

namespace lio {
namespace {

constexpr int kUnmatchedWhenLost = 5;    // coasting on is wrong by more with each scan
constexpr int kYoungScans = 10;          // with fewer a map is thin, and its cells are of no shape
constexpr double kTurnLasts_s = 0.5;     // of a body that is not seen
constexpr double kMaxCoast_s = 30.0;     // longer than that nothing goes on straight
constexpr double kPlacedStd_m = 0.5;     // a start anew is off by this at least ...
constexpr double kPlacedStd_rad = 0.05;  // ... and this

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
  return num_unmatched_in_a_row_ == 0 && !outcome.is_sought;
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
void Odometry::Impl::GoOnFromLoss(Timestamp stamp, ScoutOptions& scouting) {
  const PassedPoint& fix = loss_->last_fix;
  const double since_s = std::clamp(SecondsBetween(fix.stamp, stamp), 0.0, kMaxCoast_s);
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

}  // namespace lio
