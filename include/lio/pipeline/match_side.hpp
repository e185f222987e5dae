// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The part of the estimator that works on points: reduce, deskew, match, insert. It owns the map
// and takes self-contained jobs, so that it may run on a thread of its own. One job at a time, in
// order.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lio/pipeline/odometry.hpp"
#include "lio/registration/scan_matcher.hpp"
#include "lio/scan/reduce.hpp"
#include "lio/scan/shift_search.hpp"
#include "lio/scan/sweep.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

struct MatchJob {
  std::shared_ptr<const Sweep> sweep;
  StampedPoses T_any_imu;  // covers the sweep
  Pose T_map_imu_guess;    // at the sweep's middle
  Matrix6 guess_cov = Matrix6::Zero();
  bool clear_map = false;      // forget everything first: the estimator starts anew
  bool refine_deskew = false;  // match, deskew again along what was found, match again
  // The guess may be metres off: seek the shift against the scan before over a wide range. Up in
  // map.
  std::optional<Vector3> seek_shift_up_map;
  double since_last_fix_s = 0.1;  // how long the guess has run free at the sweep's middle
  std::int64_t filter_ns = 0;     // CPU time the filter spent since the job before
};

struct MatchOutcome {
  std::shared_ptr<const Sweep> sweep;
  MatchResult match;
  int num_used = 0;
  int num_nonfinite = 0;
  std::vector<Eigen::Vector3f> points_imu;  // deskewed, at the sweep's middle
  StageTimes stage_ns{};                    // insert: of the scan before
};

struct InsertTask {
  std::vector<Eigen::Vector3f> points_imu;
  std::optional<Pose> T_map_imu;  // absent: do not insert
};

class MatchSide {
 public:
  // Same options as the Odometry's; throws std::invalid_argument as that does.
  explicit MatchSide(const Options& options, ClockNs clock = nullptr);

  MatchOutcome Run(const MatchJob& job);
  void Insert(const InsertTask& task);

  const ScanMatcher& matcher() const { return *matcher_; }

 private:
  struct LastScan {
    std::vector<Eigen::Vector3f> points_imu;
    Pose T_map_imu;
  };

  std::int64_t Now() const { return clock_ == nullptr ? 0 : clock_(); }
  // The guess and its covariance, bettered where the job says so.
  MatchInput Guess(const MatchJob& job, const std::vector<Eigen::Vector3f>& points_imu) const;

  Pose T_imu_lidar_;
  int match_points_;
  ClockNs clock_;
  ScanReducer reducer_;
  std::unique_ptr<ScanMatcher> matcher_;
  std::optional<LastScan> last_scan_;  // the last one that was found in the map
  std::int64_t last_insert_ns_ = 0;
};

}  // namespace lio
