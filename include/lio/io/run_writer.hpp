// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes the files of one run, the same from lio-replay and from liod --out:
//   trajectory.tum: one row per scan after initialization, t x y z qx qy qz qw: the pose of imu in
//     map at the end of the sweep
//   covariance.csv: for the same rows t_s and the 6x6 covariance of [position; right rotation] of
//     the error that these poses have in a level world, as the truth is
//   trajectory_world.tum, covariance_world.csv: the same for imu in world, which is level and is
//     bent by each correction of the tilt
//   trajectory_level.tum, covariance_level.csv: the steady path in map, turned once so that it is
//     level by the last estimate (level_track.hpp); written at the end when gravity is felt
//   trajectory_base.tum: the poses of base in map, when rig.T_base_imu is given
//   trajectory_imu_rate.tum: one row per inertial sample, the pose of imu in map
//   states.csv: one row per scan: segment, status (as in status_t), trust so far (0 yes, 1
//     doubtful, 2 no), velocity in world, biases with standard deviations, clock offset, NIS
//   notices.tsv: what was told to people: stamp, severity, text
//   registration.csv: one row per scan: segment, points, residual, information, status, matched
//     points by the size of cell (matched_level_i: LevelCounts in match_status.hpp), stage times
//   stats.json: counts, speed, memory, stage times, the IMU's noise over that of the rig, how large
//   the errors of the lidar's beams are (root mean square over the rings)
//   verdict.json: whether the result may be trusted, and if not, why (verdict_report.hpp)
//   beams.yaml: what was found of the lidar's beams, to start the next run from; not where the
//   verdict trusts nothing, where most scans were blind in a direction, or where liod completes the
//   folder while it goes on
//   options.yaml: the effective options without the number of threads
//   map.pcd or map.ply: the points of the map in the frame of trajectory_level.tum, when asked for
//
// A run that starts in a map saved before has all in the frame of that map: nothing is turned.
//
// When the clock goes back, as when a log is played again to a running daemon, a segment begins:
// states.csv and registration.csv go on and count it in their column `segment`; the other files go
// on where the time that they have is passed. All rows from the step on stand in segment_2/
// besides, those from the next one on in segment_3/ and so on, under the same names.
// Rows are whole, and all files are written together: every half second of host time or after 100
// rows, whichever is sooner. So all files of a run that was killed end with the same scan, but for
// what is being written in that instant. For the same input all but the computing times is the
// same, byte for byte.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lio/io/account.hpp"
#include "lio/io/input_decoder.hpp"
#include "lio/io/quantile_sketch.hpp"
#include "lio/io/row_files.hpp"
#include "lio/pipeline/odometry.hpp"
#include "lio/verdict/verdict.hpp"

namespace lio {

struct RunStats {
  Counters counters;
  InputCounters input;
  Account account;
  std::int64_t num_skipped_bytes = 0;                       // damage of the log
  std::vector<std::pair<std::string, std::int64_t>> extra;  // further counts, in this order
  double log_duration_s = 0.0;                              // from the first message to the last
  double wall_s = 0.0;
  Verdict verdict = {};
  std::optional<LidarBeams> beams;  // as found
  int num_passes = 1;               // over the log; the files are those of the last
};

enum class MapFormat { kPcd, kPly };

class RunWriter {
 public:
  // Creates the folder when it is missing and overwrites the files of earlier runs. Throws
  // OutputError or std::runtime_error naming the file when it cannot.
  RunWriter(const std::filesystem::path& folder, const Options& options,
            StartIn start_in = StartIn::kNewMap);

  // A row that is not later than the one before is left out and counted in stats.json; one that
  // steps back by more than 0.1 s begins a segment. After a failure no more rows are written.
  void Write(const Output& output);
  // Writes the rows that are kept, for callers to whom no row comes for a while.
  void Flush();
  // Says which file could not be written first, and why, e.g. on a full disk; nothing when all is
  // well.
  [[nodiscard]] const std::optional<std::string>& failure() const { return failure_; }
  // To be called after the last row: the points are turned as the level path is.
  void WriteMap(std::span<const Eigen::Vector3f> points_map, MapFormat format = MapFormat::kPcd);
  // Writes the map as it is now into `name`, which ends with .pcd or .ply and has no folder in it.
  // Returns why it could not, in one line, or nothing; the files of the run are not touched.
  [[nodiscard]] std::string SaveMap(std::span<const Eigen::Vector3f> points_map,
                                    const std::string& name);
  // Completes all files, as far as each can be written. Throws WriteError with the failure, if
  // there was one.
  void Finish(const RunStats& stats);

 private:
  [[nodiscard]] std::filesystem::path FolderOf(int segment) const;
  // Has the clock gone back before this row?
  [[nodiscard]] bool StepsBack(const Output& output);
  // Keeps the message of the first exception.
  template <typename Action>
  void Try(Action&& action);
  void WriteRows(const Output& output);
  void Summarize(const Output& output);
  void WriteStats(const RunStats& stats);
  void WriteCloud(std::span<const Eigen::Vector3f> points_map, const std::filesystem::path& file);

  std::filesystem::path folder_;
  bool has_base_;
  bool turns_map_;                   // LevelTrack
  RowFiles whole_;                   // the run as one
  std::optional<RowFiles> segment_;  // since the last step back of the clock
  std::optional<Timestamp> last_sweep_;
  std::optional<Timestamp> last_imu_rate_;
  OutputFile notices_;
  std::optional<std::string> failure_;
  int num_kept_ = 0;  // rows since the last flush
  std::chrono::steady_clock::time_point last_flush_;
  int num_segments_ = 1;
  std::array<QuantileSketch, kNumStages> stage_ms_;
  QuantileSketch gyro_noise_ratio_;  // ImuNoiseRatios, at each scan
  QuantileSketch accel_noise_ratio_;
};

}  // namespace lio
