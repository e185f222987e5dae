// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs the part of the estimator that works on points: reduce, deskew, match, insert. It owns the
// map and takes self-contained jobs, so that it may run on a thread of its own. Jobs run one at a
// time, in order.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lio/pipeline/initial_map_entry.hpp"
#include "lio/pipeline/match_job.hpp"
#include "lio/pipeline/odometry.hpp"
#include "lio/registration/scan_matcher.hpp"
#include "lio/relocalization/relocalizer.hpp"
#include "lio/scan/dense_points.hpp"
#include "lio/scan/reduced_scan.hpp"
#include "lio/scan/repeated_sweep.hpp"

namespace lio {

class RegistrationWorker {
 public:
  // Same options as the Odometry's; throws std::invalid_argument as that does, and as
  // InitialMapEntry does. `beam_elevations_rad`: of the lidar's model, lowest beam first; only LOAM
  // wants them, for sweeps without rings.
  explicit RegistrationWorker(const Options& options, ClockNs clock = nullptr,
                              const std::vector<double>& beam_elevations_rad = {},
                              const InitialMapPtr& initial_map = nullptr);

  [[nodiscard]] MatchOutcome Run(const MatchJob& job);
  void Insert(const InsertTask& task);

  const ScanMatcher& matcher() const { return *matcher_; }
  // Returns what was found of the lidar's beams, for another pass over the same scans; that one
  // takes it before the first of them.
  const BeamCalibration& calibration() const { return calibration_; }
  void TakeCalibration(const BeamCalibration& found);
  // The errors of the lidar's beams as they are known now; absent where nothing is that would be of
  // use elsewhere, and with methods that find none. Takes a moment.
  [[nodiscard]] std::optional<LidarBeams> FoundBeams() const;
  // Scans that are inserted now go into the map that the run is about: the initial one, if there
  // is one.
  [[nodiscard]] bool is_in_map() const { return !initial_ || initial_->is_inside(); }

 private:
  struct ScanInWork;  // shared by the steps of one job

  std::int64_t Now() const { return clock_ == nullptr ? 0 : clock_(); }
  // Takes the errors of the beams off, as far as they are known.
  void CorrectBeams(std::vector<ScanPoint>& points) const;
  void AddTime(Stage stage, std::int64_t since_ns, MatchOutcome& outcome) const;
  // Clears or enters the map, as the job asks.
  void PrepareMap(const MatchJob& job);
  void ClearMap(const Vector3& up_map);
  void Reduce(const Sweep& sweep, ScanInWork& scan);
  void Do(const FindVelocity& task, ScanInWork& scan);
  void Do(const Track& task, ScanInWork& scan);
  void Do(const Relocalize& task, ScanInWork& scan);
  // Matches with these points; it counts, and without budget it finds nothing.
  MatchResult MatchFully(const MatchInput& input, ScanInWork& scan);
  // Matches with a few of the points; this ranks guesses and teaches the calibration nothing.
  MatchResult MatchCoarsely(MatchInput input, ScanInWork& scan);
  void MatchFromPrior(const Track& task, const SearchRequest* search, ScanInWork& scan);
  MatchResult MatchAsMeasured(const MotionPrior& prior, ScanInWork& scan);
  MatchResult MatchBending(const MotionPrior& prior, ScanInWork& scan);
  MatchResult MatchBentFrom(const Pose& T_map_imu_guess, const Matrix6& cov, ScanInWork& scan);
  // Turns the prior about the vertical until most of the scan lies on the map, if any of it does.
  std::optional<Pose> BestTurn(const MotionPrior& prior, ScanInWork& scan);
  void BendTo(const Pose& T_map_imu, ScanInWork& scan) const;
  void Search(const SearchRequest& request, ScanInWork& scan);
  // Deskews the scan along its motion.
  void DeskewAgain(ScanInWork& scan) const;
  void RefineDeskew(ScanInWork& scan);
  void FinishMatch(const Track& task, ScanInWork& scan);
  void SeekPlace(ScanInWork& scan);
  void TakeDensePoints(ScanInWork& scan);

  Pose T_imu_lidar_;  // the last job's
  BeamCalibration calibration_;
  double new_content_share_ = 0.0;  // the last match has brought it
  bool is_blind_ = false;           // ... in a direction
  ClockNs clock_;
  bool has_cells_;  // NDT's: they want all points of a new map's sweeps, and tell of the beams
  PointFilter filter_;
  std::unique_ptr<SweepReducer> reducer_;
  RepeatedSweepDetector repeats_;
  std::unique_ptr<ScanMatcher> matcher_;
  Relocalizer relocalizer_;
  std::unique_ptr<InitialMapEntry> initial_;  // null: no initial map
  std::int64_t last_insert_ns_ = 0;
  double range_std_m_ = 0.0;  // the noise that the last scan showed
};

}  // namespace lio
