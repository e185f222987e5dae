// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs the estimator on what its caller hands over, and writes the files of a run where they are
// asked for: lio-replay without a log.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lio/io/lidar_check.hpp"
#include "lio/io/map_cloud.hpp"
#include "lio/io/run_writer.hpp"
#include "lio/pipeline/odometry.hpp"
#include "lio/pipeline/registration_worker.hpp"
#include "python/estimate.hpp"

namespace lio::python {

struct RunSettings {
  std::filesystem::path out;  // empty: no files
  bool overwrites = false;
  bool gives_imu_rate = false;  // an estimate for each inertial sample, too
  bool keeps_map = false;
};

// One thread uses it at a time.
class OdometryRun {
 public:
  // Throws std::invalid_argument as Odometry does, UsageError for a folder with an earlier run, and
  // OutputError.
  OdometryRun(const Options& options, const RunSettings& settings);

  // All four throw UsageError after Finish, and ConfigurationError when the data contradict the
  // configuration; the estimates before that are in the files.
  void AddImu(const ImuSample& sample);
  // A sweep as one chunk; the others of its count are those that were lost.
  void AddScan(ScanChunk chunk);
  // The same; its number is one more than that of the last such sweep.
  void AddUnnumbered(ScanChunk chunk);
  // Matches what still waits, and completes the files. Throws WriteError when one of them could not
  // be written in full.
  void Finish();

  // The estimates since the last call, in order.
  [[nodiscard]] std::vector<Estimate> TakeEstimates();
  [[nodiscard]] const std::vector<Notice>& notices() const { return notices_; }
  [[nodiscard]] bool is_finished() const { return is_finished_; }
  [[nodiscard]] TrackingStatus status() const { return odometry_.status(); }
  [[nodiscard]] const Counters& counters() const { return odometry_.counters(); }
  [[nodiscard]] Verdict Judge() const;
  // The points of the map so far [m], one a voxel; empty unless it is kept.
  [[nodiscard]] const std::vector<Eigen::Vector3f>& points_map() const { return map_.points_map(); }

 private:
  void Demand() const;
  void Note(Timestamp stamp);
  void Match();
  void TakeOutputs();
  void WriteEnd();

  RunSettings settings_;
  std::optional<RunWriter> writer_;
  Odometry odometry_;
  RegistrationWorker worker_;
  LidarCheck lidar_check_;
  MapCloud map_;
  std::int32_t next_seq_ = 0;
  std::vector<Estimate> estimates_;
  std::vector<Notice> notices_;
  std::string refusal_;  // why the configuration contradicts the data; empty when it does not
  bool is_finished_ = false;
  InputCounters input_;
  std::optional<Timestamp> first_;  // stamps of the data
  Timestamp last_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace lio::python
