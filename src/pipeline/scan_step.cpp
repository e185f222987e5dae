// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/scan_step.hpp"

#include <algorithm>
#include <cmath>

#include "lio/registration/degenerate_directions.hpp"

namespace lio {
namespace {

// Returns the errors that motion within the sweep leaves in the deskewed scan, counted from its
// middle. Rotation: white gyro noise integrated to both sides has variance density^2 T / 12 in the
// mean; translation: an error dv of the velocity shifts points by dv t, T^2 / 12 in the mean
// square.
Matrix6 DeskewCov(const Sweep& sweep, const FilterHistory& history, double gyro_density) {
  const double span_s = SecondsBetween(sweep.start, sweep.end);
  Matrix6 cov = Matrix6::Zero();
  const Estimate estimate = history.At(sweep.middle());
  const double rate_error_var = std::pow(history.RateErrorStd(sweep.middle()), 2);
  const Matrix3 R = estimate.state.T_world_imu.rotation.toRotationMatrix();
  cov.topLeftCorner<3, 3>() =
      span_s * span_s / 12.0 * R.transpose() * estimate.cov.block<3, 3>(kVel, kVel) * R;
  cov.bottomRightCorner<3, 3>() =
      gyro_density * gyro_density * span_s / 12.0 * Matrix3::Identity() +
      span_s * span_s / 12.0 *
          (estimate.cov.block<3, 3>(kGyroBias, kGyroBias) + rate_error_var * Matrix3::Identity());
  return cov;
}

}  // namespace

MatchJob MakeTrackingJob(const SweepPtr& sweep, const FilterHistory& history,
                         std::optional<Timestamp> last_located) {
  const Estimate predicted = history.At(sweep->middle());
  MatchJob job;
  job.sweep = sweep;
  job.T_any_imu = history.Trajectory(sweep->start, sweep->end);
  job.prior.T_map_imu = predicted.state.T_map_imu;
  job.prior.cov = predicted.cov.block<6, 6>(kMapPose, kMapPose);
  const double turn_var = job.prior.cov.bottomRightCorner<3, 3>().diagonal().maxCoeff();
  job.refines_deskew = turn_var > kScanStep.unsure_turn_rad * kScanStep.unsure_turn_rad;
  Track track;
  if (last_located) {
    job.prior.since_last_fix_s =
        std::max(kScanStep.min_since_last_fix_s, SecondsBetween(*last_located, sweep->middle()));
    const Matrix3 velocity_cov = predicted.cov.block<3, 3>(kVel, kVel);
    const double velocity_std_mps = std::sqrt(velocity_cov.diagonal().maxCoeff());
    job.prior.shift_std_m = velocity_std_mps * job.prior.since_last_fix_s;
    track.aligns_prior = job.prior.shift_std_m > kScanStep.align_prior_from_std_m;
  }
  job.task = track;
  return job;
}

FusedMatch FuseMatch(const MatchOutcome& outcome, const MatchJudgement& judgement,
                     const FusionSettings& settings, const FilterOptions& filter,
                     FilterHistory& history) {
  PoseEvent event;
  event.measurement.T_map_imu = outcome.match.T_map_imu;
  event.measurement.cov = filter.registration_cov_scale * judgement.match_cov +
                          DeskewCov(*outcome.sweep, history, settings.gyro_density);
  event.measurement.cov *= settings.alike_factor;
  const std::optional<Matrix6>& share = outcome.match.observability.share_of_last_scan;
  if (share && settings.is_inertial) {  // nothing else tells the motion of a lidar alone
    event.measurement.cov = CovWithoutLastScan(event.measurement.cov, *share);
  }
  if (settings.grows_map) {
    event.measurement.new_content_share = outcome.match.new_content_share;
    event.measurement.blend_cov =
        filter.map_walk_scale * outcome.match.observable_cov + judgement.sensor_error_cov;
    event.measurement.is_level = settings.is_level;
  }
  event.force = judgement.force;
  event.max_unseen = judgement.max_unseen;
  if (outcome.is_clock_set) event.motion = PredictedMotion::kTakenBack;
  if (settings.replaces_motion) event.motion = PredictedMotion::kReplaced;
  UpdateResult update;
  const EventOutcome fused = history.AddPose(outcome.sweep->middle(), event, &update, share);
  return {fused, update.nis};
}

ScanReport MakeScanReport(const MatchOutcome& outcome) {
  ScanReport report;
  report.stamp = outcome.sweep->end;
  report.clock_correction = outcome.sweep->clock_correction;
  report.scan_seq = outcome.sweep->scan_seq;
  report.num_raw = static_cast<int>(outcome.sweep->points.size());
  report.num_used = outcome.num_used;
  report.num_matched = outcome.match.num_matched;
  report.num_matched_at = outcome.match.by_level.counts;
  report.num_matches = outcome.num_matches;
  report.num_coarse_matches = outcome.num_coarse_matches;
  report.iterations = outcome.match.iterations;
  report.status = outcome.match.status;
  report.residual_rms_m = outcome.match.residual_rms_m;
  report.information_eigenvalues = outcome.match.eigenvalues;
  report.degenerate_mask = outcome.match.degenerate_mask;
  return report;
}

void CompleteTimes(const StageTimes& stage_ns, std::int64_t filter_ns, ScanReport& report) {
  report.stage_ns = stage_ns;
  report.stage_ns[static_cast<std::size_t>(Stage::kFilter)] += filter_ns;
  std::int64_t& total_ns = report.stage_ns[static_cast<std::size_t>(Stage::kTotal)];
  for (int i = 0; i < kNumStages - 1; ++i) total_ns += report.stage_ns[static_cast<std::size_t>(i)];
}

}  // namespace lio
