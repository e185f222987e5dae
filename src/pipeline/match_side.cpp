// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/match_side.hpp"

#include <algorithm>
#include <utility>

#include "lio/registration/ndt_matcher.hpp"
#include "lio/scan/deskew.hpp"

namespace lio {
namespace {

// The motion during the sweep, bent so that its middle is where the scan was found: a constant
// velocity, wrong since the last scan that was found, has grown the error from nothing.
StampedPoses Bend(const MatchJob& job, const Pose& found) {
  const Vector6 correction = LogSe3(job.T_map_imu_guess.Inverse() * found);
  StampedPoses bent = job.T_any_imu;
  for (StampedPose& pose : bent) {
    const double after_middle_s = SecondsBetween(job.sweep->middle(), pose.stamp);
    pose.pose = pose.pose * ExpSe3((1.0 + after_middle_s / job.since_last_fix_s) * correction);
  }
  return bent;
}

// Every n-th point, so that about `wanted` are left. Points come by time: spread over the whole
// turn.
std::vector<Eigen::Vector3f> Thin(const std::vector<Eigen::Vector3f>& points, int wanted) {
  const double step = std::max(1.0, static_cast<double>(points.size()) / wanted);
  std::vector<Eigen::Vector3f> thinned;
  thinned.reserve(static_cast<std::size_t>(wanted) + 1);
  for (double at = 0.0; at < static_cast<double>(points.size()); at += step) {
    thinned.push_back(points[static_cast<std::size_t>(at)]);
  }
  return thinned;
}

}  // namespace

MatchSide::MatchSide(const Options& options, ClockNs clock)
    : T_imu_lidar_(options.rig.T_imu_lidar.value_or(Pose::Identity())),
      match_points_(options.reduce.match_points),
      clock_(clock),
      reducer_(options.reduce, options.rig.lidar),
      matcher_(std::make_unique<NdtMatcher>(options.ndt)) {}

MatchOutcome MatchSide::Run(const MatchJob& job) {
  const Sweep& sweep = *job.sweep;
  MatchOutcome outcome;
  outcome.sweep = job.sweep;
  StageTimes& times = outcome.stage_ns;
  const auto time = [&](Stage stage, std::int64_t since) {
    times[static_cast<std::size_t>(stage)] += Now() - since;
  };
  if (job.clear_map) matcher_->Clear();

  std::int64_t begin = Now();
  const ReducedScan reduced = reducer_.Reduce(sweep);
  outcome.num_used = std::min(static_cast<int>(reduced.points.size()), match_points_);
  outcome.num_nonfinite = reduced.num_nonfinite;
  time(Stage::kReduce, begin);

  begin = Now();
  const SweepTimes sweep_times{sweep.start, sweep.end, sweep.middle()};
  outcome.points_imu = Deskew(reduced.points, sweep_times, job.T_any_imu, T_imu_lidar_);
  time(Stage::kDeskew, begin);

  begin = Now();
  std::vector<Eigen::Vector3f> to_match = Thin(outcome.points_imu, match_points_);
  outcome.match =
      matcher_->Match({to_match, job.T_map_imu_guess, job.guess_cov, job.refine_deskew});
  time(Stage::kMatch, begin);
  if (job.refine_deskew && outcome.match.IsUsable()) {
    begin = Now();
    outcome.points_imu =
        Deskew(reduced.points, sweep_times, Bend(job, outcome.match.T_map_imu), T_imu_lidar_);
    time(Stage::kDeskew, begin);
    begin = Now();
    to_match = Thin(outcome.points_imu, match_points_);
    outcome.match = matcher_->Match({to_match, outcome.match.T_map_imu, Matrix6::Zero(), true});
    time(Stage::kMatch, begin);
  }
  times[static_cast<std::size_t>(Stage::kDecode)] = sweep.decode_ns;
  times[static_cast<std::size_t>(Stage::kInsert)] = last_insert_ns_;
  times[static_cast<std::size_t>(Stage::kFilter)] = job.filter_ns;
  last_insert_ns_ = 0;
  return outcome;
}

void MatchSide::Insert(const InsertTask& task) {
  if (!task.T_map_imu) return;
  const std::int64_t begin = Now();
  matcher_->Insert(task.points_imu, *task.T_map_imu);
  last_insert_ns_ = Now() - begin;
}

}  // namespace lio
