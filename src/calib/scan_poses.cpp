// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/calib/scan_poses.hpp"

#include <algorithm>
#include <utility>

#include "calib/calibration_parameters.hpp"

namespace lio {
namespace {

constexpr ScanPosesParameters kScanPoses = kCalibrationParameters.scan_poses;
constexpr Duration kWait = Duration::FromSeconds(kScanPoses.wait_s);

Options LidarAsBody(Options options) {
  options.rig.T_imu_lidar = Pose::Identity();
  return options;
}

}  // namespace

ScanPoses::ScanPoses(const Options& options, const SweepPath* path)
    : path_(path), matching_(LidarAsBody(options)) {}

void ScanPoses::Add(ScanChunk chunk) {
  const Timestamp stamp = chunk.stamp;
  assembler_.Add(std::move(chunk), 0);
  assembler_.CloseUpTo(stamp - kWait);
  MatchClosed();
}

void ScanPoses::Finish() {
  assembler_.CloseAll();
  MatchClosed();
}

void ScanPoses::MatchClosed() {
  while (std::optional<Sweep> sweep = assembler_.Take()) {
    const bool is_late = last_found_ && sweep->start <= *last_found_;
    if (sweep->points.empty() || is_late) continue;
    Match(std::make_shared<const Sweep>(std::move(*sweep)));
  }
}

MatchJob ScanPoses::JobByTracker(std::shared_ptr<const Sweep> sweep) {
  if (!tracker_) tracker_.emplace(sweep->start, TrackerOptions{});
  tracker_->AdvanceTo(sweep->end);
  const FilterHistory& history = tracker_->history();
  const Estimate predicted = history.At(sweep->middle());
  MatchJob job;
  job.T_any_imu = history.Trajectory(sweep->start, sweep->end);
  job.prior.T_map_imu = predicted.state.T_map_imu;
  job.prior.cov = predicted.cov.block<6, 6>(kMapPose, kMapPose);
  job.refines_deskew = true;
  if (last_found_) {
    job.prior.since_last_fix_s =
        std::max(kScanPoses.min_since_last_s, SecondsBetween(*last_found_, sweep->middle()));
  }
  job.sweep = std::move(sweep);
  return job;
}

MatchJob ScanPoses::JobAlongPath(std::shared_ptr<const Sweep> sweep) const {
  MatchJob job;
  job.T_any_imu = path_->Between(sweep->start, sweep->end);
  job.prior.T_map_imu = path_->At(sweep->middle());
  job.prior.cov.diagonal() << Vector3::Constant(kScanPoses.path_std_m * kScanPoses.path_std_m),
      Vector3::Constant(kScanPoses.path_std_rad * kScanPoses.path_std_rad);
  job.sweep = std::move(sweep);
  return job;
}

void ScanPoses::Match(std::shared_ptr<const Sweep> sweep) {
  const Timestamp middle = sweep->middle();
  MatchJob job = path_ != nullptr ? JobAlongPath(std::move(sweep)) : JobByTracker(std::move(sweep));
  if (!last_found_) job.map_action = MapAction::kClear;  // the first scan makes the map
  MatchOutcome outcome = matching_.Run(job);
  const bool starts_map = outcome.match.status == MatchStatus::kEmptyMap;
  const bool is_known = path_ == nullptr ? tracker_->AddMatch(middle, outcome.match)
                                         : starts_map || outcome.match.IsUsable();
  if (!is_known) {
    ++num_unmatched_;
    return;
  }
  // The tracker's pose is the mean of match and prediction.
  const Pose T_map_lidar =
      path_ != nullptr ? outcome.match.T_map_imu : tracker_->history().At(middle).state.T_map_imu;
  if (starts_map || keyframes_.IsKeyframe(T_map_lidar)) {
    keyframes_.Accept(T_map_lidar);
    matching_.Insert({.points_imu = std::move(outcome.points_imu),
                      .T_map_imu = T_map_lidar,
                      .tags = std::move(outcome.tags)});
  }
  last_found_ = middle;
  found_.push_back({middle, starts_map ? T_map_lidar : outcome.match.T_map_imu});
}

}  // namespace lio
