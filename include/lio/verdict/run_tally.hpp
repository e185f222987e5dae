// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Counts, over a run, how much of the input's time has poses, how far the body went, and what the
// filter claims at the end.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "lio/base/pose.hpp"
#include "lio/base/time.hpp"
#include "lio/sensor/gap.hpp"
#include "lio/sensor/imu_noise.hpp"
#include "lio/verdict/verdict.hpp"

namespace lio {

struct RunTallyParameters {
  // s. A start may take so long before it counts as missing: the longest moving window that
  // StartOptions::moving_window_s may have.
  double start_s = 3.0;
  // s. A pose covers the time since the one before up to so long.
  double max_step_s = kScanGap.unjoined.Seconds();
  // s. A longer step of the input's time is a jump of its clocks, not time. Chosen: longer than any
  // outage that is carried over.
  double max_input_step_s = 60.0;
  // m. A shorter path says nothing of drift per 100 m. Chosen: on it the start's uncertainty alone
  // would be told.
  double min_path_m = 10.0;
  // s. Inertial samples that come more seldom are slow. Chosen: from three quarters of
  // kImuGap.unmeasured on, with stamps that jitter, starts wait in vain; 20 Hz suffice.
  double slow_imu_s = 0.75 * kImuGap.unmeasured.Seconds();
  // Bins of the IMU's noise over the rig's, by powers of two. Chosen: up to 32 768, wider than any
  // unit's.
  static constexpr std::size_t kNumNoiseBins = 16;
};

inline constexpr RunTallyParameters kRunTally;

// One scan with a pose.
struct PoseRow {
  Timestamp stamp;
  bool is_located = false;  // matched and fused, or the first of a map
  Pose T_map_imu;
  Matrix3 position_cov = Matrix3::Zero();  // m^2, of the drift since the start
  Matrix3 rotation_cov = Matrix3::Zero();  // rad^2, right error of a level pose
  Quaternion R_world_imu = Quaternion::Identity();
  ImuNoiseRatios imu_noise;
  bool is_guessed = false;  // the motion along a direction, which neither scan nor IMU has told
};

class RunTally {
 public:
  void AddImu(Timestamp stamp);
  void AddSweep(Timestamp end);
  void AddRow(const PoseRow& row);

  // Share of the time from the first message to the last, without the start, that has poses.
  [[nodiscard]] double Coverage() const;
  [[nodiscard]] ClaimedAccuracy Claimed() const;
  [[nodiscard]] double path_m() const { return path_m_; }
  // The largest rotation against the first pose, rad.
  [[nodiscard]] double turned_rad() const { return turned_rad_; }
  // How long the input goes on after the last sweep, and after the last inertial sample, s.
  [[nodiscard]] double WithoutSweeps_s() const;
  [[nodiscard]] double WithoutImu_s() const;
  // Is the time between most inertial samples so long that the filter takes them for missing?
  [[nodiscard]] bool IsImuSlow() const { return 2 * num_slow_imu_ > num_imu_; }
  // The longest time in a row for which all poses were guessed along a direction, s.
  [[nodiscard]] double Guessed_s() const { return longest_guess_s_; }
  // The noise over the rig's that half of all rows exceed, to a factor of two; 0 without rows.
  [[nodiscard]] ImuNoiseRatios MedianNoise() const;
  [[nodiscard]] std::int64_t num_rows() const { return num_rows_; }

 private:
  using NoiseBins = std::array<std::int64_t, RunTallyParameters::kNumNoiseBins>;
  void Include(Timestamp stamp);

  std::optional<Timestamp> first_, last_imu_, last_sweep_;
  double total_s_ = 0.0;  // span of the input, without jumps of its clocks
  std::optional<Timestamp> newest_;
  std::optional<Pose> first_pose_;
  std::optional<PoseRow> last_row_;
  double covered_s_ = 0.0;
  double path_m_ = 0.0;
  double turned_rad_ = 0.0;
  double guess_s_ = 0.0;  // since the last pose that was not guessed
  double longest_guess_s_ = 0.0;
  std::int64_t num_rows_ = 0;
  std::int64_t num_imu_ = 0;
  std::int64_t num_slow_imu_ = 0;  // so long after the one before
  NoiseBins gyro_noise_{};
  NoiseBins accel_noise_{};
};

}  // namespace lio
