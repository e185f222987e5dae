// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes the files of a run that have a row for each scan or sample: trajectories, covariances,
// states.csv and registration.csv in one folder (run_writer.hpp says which).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lio/io/level_track.hpp"
#include "lio/io/output_file.hpp"
#include "lio/pipeline/odometry.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

class RowFiles {
 public:
  // Creates the folder when it is missing and overwrites its files. Throws std::runtime_error
  // naming the file when it cannot; the others throw WriteError when a file could not be written in
  // full. For `turns_map` see LevelTrack.
  RowFiles(const std::filesystem::path& folder, bool has_base, bool turns_map = true);

  // A pose that is not later than the one before is left out and counted. `segment`: 1, and one
  // more each time the clock went back; a new one's first rows of states.csv may be earlier.
  void Write(const Output& output, int segment);
  [[nodiscard]] Quaternion R_level_map() const { return level_.R_level_map(); }
  [[nodiscard]] std::int64_t num_rows_not_later() const { return num_rows_not_later_; }
  // Rows are kept until then: all files end with the rows of the same scan.
  void Flush();
  // Completes all files.
  void Finish();

 private:
  struct Track {  // poses and their covariances
    OutputFile poses, covariances;
  };

  struct LastState {
    int segment = 1;
    Timestamp stamp;
  };

  [[nodiscard]] static Track OpenTrack(const std::filesystem::path& folder,
                                       const std::string& frame);
  static void WriteRow(const StampedPose& pose, const Matrix6& cov, Track& track);
  [[nodiscard]] std::vector<OutputFile*> files();
  void WriteScan(const ScanOutput& output, int segment);
  void WriteState(const ScanOutput& output, int segment);
  void WriteImuRate(const NavOutput& nav);

  Track in_map_;
  Track in_world_;
  LevelTrack level_;
  std::optional<OutputFile> base_;
  OutputFile imu_rate_;
  OutputFile states_;
  OutputFile registration_;
  std::optional<Timestamp> last_scan_;
  std::optional<Timestamp> last_imu_rate_;
  std::optional<LastState> last_state_;
  std::int64_t num_rows_not_later_ = 0;
};

}  // namespace lio
