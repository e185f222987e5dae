// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "pipeline/odometry_impl.hpp"

namespace lio {
namespace {

constexpr double kLost_s = 2.0;            // no accepted match for this long
constexpr int kMaxUnmatchedInARow = 10;    // then the map goes on from where the IMU says
constexpr double kUnsureTurn_rad = 0.005;  // the sweep may be bent by this: inertial samples lack
constexpr double kSeekStd_m = 0.7;  // a shift since the last scan less sure than this is sought
// At rest the same beams meet the same cells, and errors last: over five seconds they come to one
// to four times the variance that independent ones would have (docs/consistency.md).
constexpr double kAlikeAtRest = 4.0;
constexpr int kMinPointsToGrow = 200;  // a scan of fewer points tells nothing of the map

}  // namespace

std::optional<MatchJob> Odometry::Impl::NextJob() {
  if (in_flight_) return std::nullopt;
  const std::size_t at = phase_ == Phase::kScouting ? scouted_.size() : 0;
  if (at >= ready_.size()) return std::nullopt;
  const std::int64_t begin = Now();
  ready_[at] = MovedByClockOffset(ready_[at]);
  in_flight_ = ready_[at];
  const bool is_first = phase_ == Phase::kScouting ? scouted_.empty() : is_first_scan_;
  const bool needs_scout = phase_ == Phase::kScouting || !use_imu_;
  if (needs_scout) {
    const bool is_back = scout_ && in_flight_->end <= scout_->history().head().stamp;
    if (is_first) {
      BeginScouting(*in_flight_);
    } else if (is_back) {
      scout_->SetClock(in_flight_->start);
      last_found_ = in_flight_->start;
    }
    AdvanceScout(in_flight_->end);
  }
  MatchJob job = MakeJob(in_flight_, is_first);
  job.filter_ns = filter_ns_ + Now() - begin;
  filter_ns_ = 0;
  return job;
}

MatchJob Odometry::Impl::MakeJob(const SweepPtr& sweep, bool clear_map) {
  const Estimate predicted = history().At(sweep->middle());
  MatchJob job;
  job.sweep = sweep;
  job.T_any_imu = history().Trajectory(sweep->start, sweep->end);
  job.T_map_imu_guess = predicted.state.T_map_imu;
  job.guess_cov = predicted.cov.bottomRightCorner<6, 6>();
  job.clear_map = clear_map;
  job.hold_by_view = scout_.has_value();
  job.is_map_young = IsMapYoung();
  const double turn_var = job.guess_cov.bottomRightCorner<3, 3>().diagonal().maxCoeff();
  job.refine_deskew = scout_ || turn_var > kUnsureTurn_rad * kUnsureTurn_rad;
  job.up_map = UpInMap(predicted.state);
  job.T_map_imu_if_clock_set = GuessIfClockSet(*sweep, predicted.state.T_map_imu);
  if (last_found_) {
    job.since_last_fix_s = std::max(0.01, SecondsBetween(*last_found_, sweep->middle()));
    const Matrix3 velocity_cov = predicted.cov.block<3, 3>(kVel, kVel);
    const double velocity_std_mps = std::sqrt(velocity_cov.diagonal().maxCoeff());
    job.shift_std_m = velocity_std_mps * job.since_last_fix_s;
    if (job.shift_std_m > kSeekStd_m) job.seek = MatchJob::Seek::kShift;
    if (phase_ == Phase::kRunning) {
      using enum MatchJob::SeekPlace;
      if (IsAfterStepInDoubt(*sweep)) job.seek_place = kWhereHeld;
      if (!use_imu_) job.seek_place = kAnywhere;
    }
  }
  if (phase_ == Phase::kScouting && !has_sought_) job.seek = MatchJob::Seek::kVelocity;
  return job;
}

InsertTask Odometry::Impl::FinishJob(MatchOutcome outcome) {
  InsertTask insert = TakeOutcome(std::move(outcome));
  if (IsBetweenStretches() && is_step_judged_ && !HasWork()) ResumeAfterStretch();
  return insert;
}

InsertTask Odometry::Impl::TakeOutcome(MatchOutcome outcome) {
  InsertTask insert;
  const bool is_current = in_flight_ && outcome.sweep == in_flight_;
  in_flight_.reset();
  counters_.num_points_nonfinite += outcome.num_nonfinite;
  const std::size_t at = phase_ == Phase::kScouting ? scouted_.size() : 0;
  if (!is_current || at >= ready_.size() || ready_[at] != outcome.sweep) return insert;
  if (phase_ == Phase::kScouting) {
    FinishScouting(outcome, insert);
  } else {
    FinishRunning(outcome, insert);
    ready_.pop_front();
    if (!use_imu_) StartAnewByLidar(outcome.sweep->end);
    if (history_) {
      history_->KeepFrom(ready_.empty() ? std::nullopt
                                        : std::optional(ready_.front()->start - ClockMargin()));
      JudgeWhileRunning(outcome.sweep->end);
      StartAnewWhenLost(outcome.sweep->end);
    }
  }
  insert.points_imu = std::move(outcome.points_imu);
  insert.tags = std::move(outcome.tags);
  return insert;
}

// What the motion within the sweep leaves of errors in the deskewed scan, counted from its middle.
// Rotation: white gyro noise integrated to both sides has variance density^2 T / 12 in the mean;
// translation: an error dv of the velocity shifts points by dv t, T^2 / 12 in the mean square.
Matrix6 Odometry::Impl::DeskewCov(const Sweep& sweep) {
  const double span_s = SecondsBetween(sweep.start, sweep.end);
  Matrix6 cov = Matrix6::Zero();
  const Estimate estimate = history().At(sweep.middle());
  const Matrix3 R = estimate.state.T_world_imu.rotation.toRotationMatrix();
  cov.topLeftCorner<3, 3>() =
      span_s * span_s / 12.0 * R.transpose() * estimate.cov.block<3, 3>(kVel, kVel) * R;
  const double density = use_imu_ ? options_.rig.imu.gyro_noise_density : 0.0;
  cov.bottomRightCorner<3, 3>() =
      density * density * span_s / 12.0 * Matrix3::Identity() +
      span_s * span_s / 12.0 * estimate.cov.block<3, 3>(kGyroBias, kGyroBias);
  return cov;
}

bool Odometry::Impl::Fuse(const MatchOutcome& outcome, bool grows_map, ScanReport& report) {
  const FilterOptions& filter = options_.filter;
  PoseEvent event;
  event.measurement.T_map_imu = outcome.match.T_map_imu;
  event.measurement.cov =
      filter.registration_cov_scale * outcome.match.cov + DeskewCov(*outcome.sweep);
  if (last_standstill_) event.measurement.cov *= kAlikeAtRest;
  event.measurement.new_content_share = grows_map ? outcome.match.new_content_share : 0.0;
  event.measurement.blend_cov = filter.map_walk_scale * outcome.match.observable_cov;
  event.is_clock_set = outcome.is_clock_set;
  event.force = outcome.is_sought || num_gated_in_a_row_ >= filter.max_gated_in_a_row;
  UpdateResult update;
  const EventOutcome fused = history().AddPose(outcome.sweep->middle(), event, &update);
  report.nis = update.nis;
  gated_scans_ = gated_scans_ << 1 | (fused == EventOutcome::kGated ? 1U : 0U);
  if (fused == EventOutcome::kApplied) {
    num_gated_in_a_row_ = 0;
    return true;
  }
  if (fused == EventOutcome::kGated) {
    ++counters_.num_gated;
    ++num_gated_in_a_row_;
  } else {
    ++counters_.num_scans_late;
  }
  return false;
}

void Odometry::Impl::FinishRunning(MatchOutcome& outcome, InsertTask& insert) {
  const std::int64_t begin = Now();
  const Timestamp middle = outcome.sweep->middle();
  ScanReport report;
  report.stamp = outcome.sweep->end;
  report.scan_seq = outcome.sweep->scan_seq;
  report.num_raw = static_cast<int>(outcome.sweep->points.size());
  report.num_used = outcome.num_used;
  report.num_matched = outcome.match.num_matched;
  report.iterations = outcome.match.iterations;
  report.status = outcome.match.status;
  report.residual_rms_m = outcome.match.residual_rms_m;
  report.information_eigenvalues = outcome.match.eigenvalues;
  report.degenerate_mask = outcome.match.degenerate_mask;

  const bool starts_map = outcome.match.status == MatchStatus::kEmptyMap;
  const bool is_keyframe =
      keyframes_.IsKeyframe(outcome.match.T_map_imu) && (use_imu_ || IsPlaceSure(outcome));
  if (outcome.match.IsUsable()) {
    TellClassifier({middle, outcome.match.T_map_imu});
    report.fused = Fuse(outcome, is_keyframe, report);
  }
  if (report.fused) SettleStepInDoubt(outcome);
  if (!starts_map) FuseStandstill(outcome, report.fused);
  if (clock_offset_) FollowClockOffset(outcome);
  const bool sees_enough = outcome.num_used >= kMinPointsToGrow;
  const bool is_sound = report.fused && IsPlaceSure(outcome);
  if (report.fused || starts_map) {
    num_unmatched_in_a_row_ = 0;
  } else if (sees_enough) {
    ++num_unmatched_in_a_row_;
  }
  if (!report.fused && !starts_map) ++counters_.num_matches_rejected;
  // Where the map has nothing to match against, it is grown from where the IMU says.
  const bool leaves_map = use_imu_ && sees_enough &&
                          (outcome.match.status == MatchStatus::kTooFewPoints ||
                           num_unmatched_in_a_row_ > kMaxUnmatchedInARow);
  if (starts_map || leaves_map) (void)history().AddRebase(middle);
  const Estimate estimate = history().At(middle);
  const bool grows_map = starts_map || leaves_map || (report.fused && is_keyframe);
  if (grows_map) {
    insert.T_map_imu = estimate.state.T_map_imu;
    keyframes_.Accept(estimate.state.T_map_imu);
  }
  if (report.fused || starts_map) {
    last_fused_ = outcome.sweep->end;
    last_found_ = middle;
    last_seq_ = outcome.sweep->scan_seq;
  }
  is_first_scan_ = false;
  ++num_scans_in_map_;
  UpdateStatus(outcome, report.fused || starts_map);

  report.stage_ns = outcome.stage_ns;
  std::int64_t& filter_ns = report.stage_ns[static_cast<std::size_t>(Stage::kFilter)];
  filter_ns += Now() - begin;
  for (int i = 0; i < kNumStages - 1; ++i) {
    report.stage_ns[static_cast<std::size_t>(Stage::kTotal)] +=
        report.stage_ns[static_cast<std::size_t>(i)];
  }
  if (is_sound) last_fix_ = MakeFix(middle, estimate);
  const Timestamp end = outcome.sweep->end;
  const Estimate at_end =
      scout_ && report.fused ? scout_->AtEnd(middle, end, outcome.turn_rate) : history().At(end);
  outputs_.emplace_back(ScanOutput{MakeFilterReport(at_end, report), report});
}

void Odometry::Impl::UpdateStatus(const MatchOutcome& outcome, bool fused) {
  const TrackingStatus before = status_;
  if (fused) {
    status_ =
        outcome.match.degenerate_mask != 0 ? TrackingStatus::kDegenerate : TrackingStatus::kOk;
  } else {
    const double silent_s =
        last_fused_ ? SecondsBetween(*last_fused_, outcome.sweep->end) : kLost_s;
    status_ = silent_s >= kLost_s ? TrackingStatus::kLost : TrackingStatus::kCoasting;
  }
  if (status_ == TrackingStatus::kLost && before != TrackingStatus::kLost) {
    Say(outcome.sweep->end, Notice::Severity::kWarning,
        "lost: no scan was matched for two seconds");
  }
}

}  // namespace lio
