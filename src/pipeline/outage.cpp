// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/outage.hpp"

#include <algorithm>
#include <cmath>

#include "lio/filter/estimate_change.hpp"
#include "lio/filter/world_yaw.hpp"
#include "lio/imu/initialization_parameters.hpp"

namespace lio {
namespace {

Matrix3 LevelCov(double horizontal_std, double vertical_std) {
  const double horizontal_var = horizontal_std * horizontal_std;
  return Vector3(horizontal_var, horizontal_var, vertical_std * vertical_std).asDiagonal();
}

}  // namespace

double UnseenTurnStd_rad(double unseen_s) {
  return std::min(kOutage.turn_rate_std_radps * unseen_s, kOutage.max_yaw_std_rad);
}

Estimate AcrossOutage(Estimate before, Timestamp now) {
  const double unseen_s = std::abs(SecondsBetween(before.stamp, now));
  const double coasted_s = std::min(unseen_s, kInitializationParameters.at_rest.max_coast_s);
  const double speed_mps = std::max(before.state.v_world_imu.norm(), kOutage.min_speed_mps);
  const double std_m = std::min(speed_mps * unseen_s, kOutage.max_std_m);
  const double yaw_std_rad = UnseenTurnStd_rad(unseen_s);
  const double velocity_std_mps = std::max(speed_mps, kOutage.velocity_std_mps);

  const Matrix3 R_imu_world = before.state.T_world_imu.rotation.conjugate().toRotationMatrix();
  const auto in_imu = [&](const Matrix3& cov_world) -> Matrix3 {
    return R_imu_world * cov_world * R_imu_world.transpose();
  };
  Matrix6 motion_cov = Matrix6::Zero();
  motion_cov.topLeftCorner<3, 3>() = in_imu(LevelCov(std_m, kOutage.slope * std_m));
  motion_cov.bottomRightCorner<3, 3>() = in_imu(LevelCov(kOutage.tilt_std_rad, yaw_std_rad));

  const Vector3 v_imu_mps = R_imu_world * before.state.v_world_imu;
  Estimate estimate = std::move(before);
  Pose driven_on = estimate.state.T_map_imu;
  driven_on.translation += driven_on.rotation * (coasted_s * v_imu_mps);
  MoveTo(driven_on, estimate);
  AddUnseenMotion(estimate, motion_cov);
  SetVelocity(v_imu_mps, LevelCov(velocity_std_mps, kOutage.slope * velocity_std_mps), estimate);
  estimate.stamp = now;
  return estimate;
}

bool MoveUnsureYaw(Estimate& estimate, YawDoubt& doubt) {
  Estimate without_yaw = estimate;
  const double yaw_var = TakeOutYaw(without_yaw);
  if (yaw_var < kOutage.known_yaw_std_rad * kOutage.known_yaw_std_rad) return false;
  doubt.Add(yaw_var, without_yaw.state.T_world_imu.translation);
  estimate = std::move(without_yaw);
  return true;
}

void OutageRecovery::Begin(const Estimate& before, const Pose& T_map_imu_seen) {
  before_ = before;
  T_map_imu_seen_ = T_map_imu_seen;
  Enter(last_match_.degenerate_mask == 0 ? Stage::kSeek : Stage::kFindVelocity);
}

void OutageRecovery::BeginNewMap(const Estimate& before) {
  before_ = before;
  Enter(Stage::kFindVelocity);
}

void OutageRecovery::Enter(Stage stage) {
  stage_ = stage;
  num_scans_ = 0;
  num_checked_ = 0;
}

bool OutageRecovery::MatchesAsBefore(const MatchResult& match) const {
  const auto is_enough = [](int now, int before) {
    return now >= kOutage.min_share_matched * before;
  };
  return is_enough(match.num_matched, last_match_.num_matched) &&
         is_enough(match.by_level.num_in_finest, last_match_.by_level.num_in_finest);
}

void OutageRecovery::SetTask(const std::optional<Pose>& T_map_imu_if_set, MatchJob& job) const {
  if (stage_ == Stage::kSeek) {
    job.task = Relocalize{Track{}, {SearchRegion::kObservable, T_map_imu_if_set}};
  } else if (stage_ == Stage::kFindVelocity) {
    job.task = FindVelocity{};
    if (num_scans_ == 0) job.map_action = MapAction::kClear;
  } else if (stage_ == Stage::kBeginMap) {
    job.task = Track{};
    job.map_action = MapAction::kClear;
  }
}

OutageRecovery::Event OutageRecovery::AddSought(const MatchOutcome& outcome, bool is_fused) {
  if (is_fused) {
    moved_m_ = (outcome.match.T_map_imu.translation - T_map_imu_seen_.translation).norm();
    Enter(Stage::kCheck);
  } else if (num_scans_ >= kOutage.max_scans_sought) {
    Enter(Stage::kFindVelocity);
    return Event::kFoundNowhere;
  }
  return Event::kNone;
}

OutageRecovery::Event OutageRecovery::AddChecked(const MatchOutcome& outcome, bool is_fused) {
  if (is_fused && MatchesAsBefore(outcome.match)) ++num_checked_;
  if (num_checked_ >= kOutage.num_checks) {
    Enter(Stage::kNone);
    return Event::kConfirmed;
  }
  if (num_scans_ >= kOutage.max_scans_checked) {
    Enter(Stage::kFindVelocity);
    return Event::kContradicted;
  }
  return Event::kNone;
}

OutageRecovery::Event OutageRecovery::AddScan(const MatchOutcome& outcome, bool is_fused,
                                              bool sees_enough) {
  if (sees_enough) ++num_scans_;
  switch (stage_) {
    case Stage::kNone:
      break;
    case Stage::kSeek:
      return AddSought(outcome, is_fused);
    case Stage::kCheck:
      return AddChecked(outcome, is_fused);
    case Stage::kFindVelocity:
      if (outcome.v_map_imu_mps || num_scans_ >= kOutage.max_scans_for_velocity) {
        Enter(Stage::kBeginMap);
      }
      break;
    case Stage::kBeginMap:
      if (outcome.match.status == MatchStatus::kEmptyMap) Enter(Stage::kConfirm);
      break;
    case Stage::kConfirm:
      if (is_fused) Enter(Stage::kNone);
      break;
  }
  return Event::kNone;
}

}  // namespace lio
