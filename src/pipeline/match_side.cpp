// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/match_side.hpp"

#include <utility>

#include "lio/registration/ndt_matcher.hpp"
#include "lio/scan/deskew.hpp"

namespace lio {
namespace {

// The motion during the sweep, bent so that it ends where the scan was found: the correction grows
// linearly from nothing at the sweep's start.
StampedPoses Bend(const StampedPoses& T_any_imu, const Pose& guess, const Pose& found) {
  const Vector6 correction = LogSe3(guess.Inverse() * found);
  const Timestamp start = T_any_imu.front().stamp;
  const double span_s = SecondsBetween(start, T_any_imu.back().stamp);
  StampedPoses bent = T_any_imu;
  for (StampedPose& pose : bent) {
    const double share = span_s > 0 ? SecondsBetween(start, pose.stamp) / span_s : 1.0;
    pose.pose = pose.pose * ExpSe3(share * correction);
  }
  return bent;
}

}  // namespace

MatchSide::MatchSide(const Options& options, ClockNs clock)
    : T_imu_lidar_(options.rig.T_imu_lidar.value_or(Pose::Identity())),
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
  outcome.num_used = static_cast<int>(reduced.points.size());
  outcome.num_nonfinite = reduced.num_nonfinite;
  time(Stage::kReduce, begin);

  begin = Now();
  outcome.points_imu = Deskew(reduced.points, sweep.start, sweep.end, job.T_any_imu, T_imu_lidar_);
  time(Stage::kDeskew, begin);

  begin = Now();
  outcome.match = matcher_->Match({outcome.points_imu, job.T_map_imu_guess, job.guess_cov});
  time(Stage::kMatch, begin);
  if (job.refine_deskew && outcome.match.IsUsable()) {
    begin = Now();
    outcome.points_imu =
        Deskew(reduced.points, sweep.start, sweep.end,
               Bend(job.T_any_imu, job.T_map_imu_guess, outcome.match.T_map_imu), T_imu_lidar_);
    time(Stage::kDeskew, begin);
    begin = Now();
    outcome.match = matcher_->Match({outcome.points_imu, outcome.match.T_map_imu, Matrix6::Zero()});
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
