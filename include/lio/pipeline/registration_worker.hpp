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
#include "lio/relocalization/shift_search.hpp"
#include "lio/relocalization/velocity_search.hpp"
#include "lio/scan/dense_points.hpp"
#include "lio/scan/reduced_scan.hpp"
#include "lio/scan/sweep.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

struct MatchJob {
  std::shared_ptr<const Sweep> sweep;
  StampedPoses T_any_imu;  // covers the sweep
  Pose T_map_imu_guess;    // at the sweep's middle
  Matrix6 guess_cov = Matrix6::Zero();
  bool clear_map = false;      // forget everything first
  bool hold_by_view = false;   // a match with weak directions, by the things that stand around
  bool is_map_young = false;   // this scan is inserted unthinned, as the first one is
  bool refine_deskew = false;  // match, deskew again along what was found, match again
  // Over a wide range: kShift, since the last scan that was found, to better the guess; kVelocity,
  // of the scans since clear_map, and nothing is matched.
  enum class Seek { kNothing, kShift, kVelocity } seek = Seek::kNothing;
  // Where it is if no time has passed at a step of the stamps, tried as well.
  std::optional<Pose> T_map_imu_if_clock_set;
  // Where the scan is not found as guessed, look for it farther around; kWhereHeld: unless the last
  // one that was found had weak directions, which the inertial unit knows better.
  enum class SeekPlace { kNowhere, kWhereHeld, kAnywhere } seek_place = SeekPlace::kNowhere;
  Vector3 up_map = Vector3::UnitZ();  // about; for seeking
  double shift_std_m = 1.0;           // of the guessed shift since the last scan that was found
  double since_last_fix_s = 0.1;      // how long the guess has run free at the sweep's middle
  std::int64_t filter_ns = 0;         // CPU time the filter spent since the job before
};

struct MatchOutcome {
  std::shared_ptr<const Sweep> sweep;
  MatchResult match;
  bool is_sought = false;                // found, but farther around
  bool is_clock_set = false;             // found at T_map_imu_if_clock_set
  std::optional<Vector3> v_map_imu_mps;  // sought and found
  std::optional<TurnRate> turn_rate;     // as the sweep itself shows it, with refine_deskew
  int num_used = 0;
  int num_nonfinite = 0;
  std::vector<Eigen::Vector3f> points_imu;       // deskewed, at the sweep's middle
  std::vector<FeatureTag> tags;                  // of each point; empty where the method needs none
  std::shared_ptr<const LoamFeatures> features;  // of the sweep, where the method has them
  StageTimes stage_ns{};                         // insert: of the scan before
};

struct InsertTask {
  std::vector<Eigen::Vector3f> points_imu;
  std::optional<Pose> T_map_imu;      // absent: do not insert
  std::vector<FeatureTag> tags = {};  // of each point; empty where the method needs none
};

class RegistrationWorker {
 public:
  // Same options as the Odometry's; throws std::invalid_argument as that does.
  // `beam_elevations_rad`: of the lidar's model, lowest beam first; only LOAM wants them, for
  // sweeps without rings.
  explicit RegistrationWorker(const Options& options, ClockNs clock = nullptr,
                              const std::vector<double>& beam_elevations_rad = {});

  MatchOutcome Run(const MatchJob& job);
  void Insert(const InsertTask& task);

  const ScanMatcher& matcher() const { return *matcher_; }

 private:
  struct FoundScan {
    Timestamp stamp;
    std::vector<Eigen::Vector3f> points_imu;
    MatchResult match;
  };

  std::int64_t Now() const { return clock_ == nullptr ? 0 : clock_(); }
  void AddTime(Stage stage, std::int64_t since_ns, MatchOutcome& outcome) const;
  void SeekVelocity(const MatchJob& job, MatchOutcome& outcome);
  void Match(const MatchJob& job, const ReducedScan& reduced, MatchOutcome& outcome);
  // By the things that stand around: registration_worker_shift.cpp.
  void HoldByView(const MatchJob& job, MatchOutcome& outcome);
  // Where the scan was not found as guessed, in the places where it may be:
  // registration_worker_place.cpp.
  void SeekPlace(const MatchJob& job, MatchInput input, MatchOutcome& outcome);
  // Where it would be had no time passed, if it fits better there.
  void TryClockSet(const MatchJob& job, MatchInput input, MatchOutcome& outcome);
  // The job's guess, bettered by the shift since the last scan.
  MatchInput SeekShift(const MatchJob& job, MatchInput input) const;

  Pose T_imu_lidar_;
  ClockNs clock_;
  bool feeds_young_map_;  // with all that a sweep shows: only NDT's cells want it
  PointFilter filter_;
  std::unique_ptr<SweepReducer> reducer_;
  std::unique_ptr<ScanMatcher> matcher_;
  VelocitySearch velocity_search_;
  std::vector<PlacedView> views_;  // of the last scans that were matched, some way apart
  std::optional<FoundScan> last_found_;
  std::int64_t last_insert_ns_ = 0;
};

}  // namespace lio
