// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes the path of a run as it looks when the run is over: the steady path in map, turned once,
// rigidly and about its origin, so that it is level by the last estimate. It keeps its shape, and
// its height does not drift by the tilt that the start did not know. Its body is that of the last
// extrinsic, and its stamps have the clock offset that the whole run tells of each scan
// (filter/clock_smoother.hpp), before these were found too. It is written at the end as
// trajectory_level.tum and covariance_level.csv; until then rows wait in a file beside them,
// trajectory_level.rows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>

#include "lio/pipeline/outputs.hpp"

namespace lio {

class LevelTrack {
 public:
  // Removes the files of an earlier run. Throws OutputError naming the file when it cannot be
  // created; the others throw WriteError when it cannot be written in full. Without `turns_map` the
  // path stays in the map's frame: that of a map saved before.
  explicit LevelTrack(const std::filesystem::path& folder, bool turns_map = true);

  // `clock_correction` is what the estimated clock offset has added to the stamp.
  void Add(const FilterReport& filter, Duration clock_correction);
  // Turns the map's frame into the level one, by the last row; the identity when no gravity was
  // felt and where the map is not turned.
  [[nodiscard]] Quaternion R_level_map() const;
  // Until then the last rows may be in memory alone.
  void Flush();
  // Writes the two files, unless nothing levels the path: no gravity was felt.
  void Finish();

 private:
  struct Row {
    std::int64_t stamp_ns = 0;
    std::int64_t clock_correction_ns = 0;
    bool has_clock = false;  // the next three are known
    std::int64_t clock_as_of_ns = 0;
    double clock_mean[2] = {};
    double clock_cov[4] = {};
    double T_map_imu[7] = {};    // translation, then rotation x y z w
    double T_world_imu[7] = {};  // likewise
    double T_imu_lidar[7] = {};  // in use
    double pose_cov[36] = {};    // covariance of T_world_imu
  };

  static void Put(const Pose& pose, double (&to)[7]);
  [[nodiscard]] static Pose Get(const double (&from)[7]);
  [[nodiscard]] static std::optional<ClockEstimate> ClockOf(const Row& row);
  // Goes through the waiting rows from last to first.
  void SmoothClock();
  void WriteFiles();
  [[nodiscard]] Pose LastImuPose(const Row& row) const;

  std::filesystem::path folder_;
  std::filesystem::path rows_path_;
  std::fstream rows_;
  Row last_;
  std::int64_t num_rows_ = 0;
  bool turns_map_;
  bool is_level_known_ = false;
};

}  // namespace lio
