// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The odometry tells the world this: plain data, encoded by lio_io and written by the programs.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lio/base/counters.hpp"
#include "lio/base/pose.hpp"
#include "lio/base/time.hpp"
#include "lio/filter/clock_estimate.hpp"
#include "lio/registration/match_status.hpp"
#include "lio/sensor/imu_noise.hpp"

namespace lio {

enum class TrackingStatus : std::int8_t {
  kInit = 0,  // waiting for a start
  kOk = 1,
  kDegenerate = 2,  // matched, but some direction is not held by the scene
  kCoasting = 3,    // no accepted match; carried by the IMU
  kLost = 4,        // no accepted match for long
};

enum class OdometrySource : std::int8_t { kScanUpdate = 0, kImuPropagated = 1 };

// Holds the state of the rig's base frame. Covariances are those of NavOutput, for base.
struct BaseMotion {
  Pose T_world_base;
  Matrix6 pose_cov = Matrix6::Zero();
  Vector3 v_world_base_mps = Vector3::Zero();  // velocity of base's origin
  Matrix3 velocity_cov = Matrix3::Zero();
  Vector3 w_base_radps = Vector3::Zero();  // bias-corrected rate, in base
  Pose T_map_base;
  Matrix6 map_pose_cov = Matrix6::Zero();
};

// Holds the state at one instant: in world, which is level, and in map, which is steady.
// Covariances: position and velocity in world, rotation error on the right (R_true = R Exp(d)),
// order [position; rotation].
struct NavOutput {
  Timestamp stamp;
  std::int64_t scan_seq = -1;  // the last scan that was fused
  TrackingStatus status = TrackingStatus::kInit;
  OdometrySource source = OdometrySource::kScanUpdate;
  Pose T_world_imu;
  Matrix6 pose_cov = Matrix6::Zero();
  Vector3 v_world_imu_mps = Vector3::Zero();
  Matrix3 velocity_cov = Matrix3::Zero();
  Vector3 w_imu_radps = Vector3::Zero();  // bias-corrected rate, in imu
  Pose T_map_imu;
  Matrix6 map_pose_cov = Matrix6::Zero();  // right error [translation; rotation] of T_map_imu
  std::optional<BaseMotion> base;          // with rig.T_base_imu
};

// Reports the filter in full, once a scan. Errors are ordered position, rotation, velocity, gyro
// bias, accel bias, then the right error of T_map_imu [translation; rotation].
struct FilterReport {
  NavOutput nav;
  bool is_inertial = false;  // an IMU tells the motion between scans
  Vector3 v_map_imu_mps = Vector3::Zero();
  Matrix3 map_velocity_cov = Matrix3::Zero();  // in map
  Matrix6 map_as_world_cov = Matrix6::Zero();  // mean square error of T_map_imu as one in world
  Vector3 gyro_bias_radps = Vector3::Zero();
  Vector3 accel_bias_mps2 = Vector3::Zero();
  Vector3 g_world_mps2 = Vector3::Zero();  // zero where none is felt
  // To be added to the lidar's stamps, rig.lidar.clock_offset_s included; the standard deviation is
  // zero unless it is estimated.
  double clock_offset_s = 0.0;
  double clock_offset_std_s = 0.0;
  // Holds what is known beyond rig.lidar.clock_offset_s, once stamps are moved by it.
  std::optional<ClockEstimate> found_clock;
  Pose T_imu_lidar;          // in use: the rig's, or as corrected on the way
  ImuNoiseRatios imu_noise;  // zero where it is not known
  double nis = 0.0;          // normalised innovation squared of the last update
  int nis_dof = 0;           // 0: no update
  // 21 x 21, all blocks in the order above. The pose and velocity are those in `nav`.
  Eigen::MatrixXd cov;
};

enum class Stage { kDecode, kReduce, kDeskew, kMatch, kInsert, kFilter, kTotal };
inline constexpr int kNumStages = 7;
using StageTimes = std::array<std::int64_t, kNumStages>;  // ns of CPU work, indexed by Stage

// Reports one registration: a row of registration.csv.
struct ScanReport {
  Timestamp stamp;            // sweep end
  Duration clock_correction;  // in the stamp, by the estimated clock offset
  std::int64_t scan_seq = 0;
  int num_raw = 0;
  int num_used = 0;
  int num_matched = 0;           // points
  LevelCounts num_matched_at{};  // the same by level of the map; method ndt
  int num_matches = 0;         // full matches against the map, of guesses and after another deskew
  int num_coarse_matches = 0;  // with a few hundred points, to rank the candidates of a search
  int iterations = 0;          // in the last match
  MatchStatus status = MatchStatus::kConverged;
  bool fused = false;
  double residual_rms_m = 0.0;
  Vector6 information_eigenvalues = Vector6::Zero();  // those of weak directions first
  unsigned degenerate_mask = 0;                       // bit i: eigenvalue i is a weak direction
  double nis = 0.0;
  StageTimes stage_ns{};
};

// Holds registered points for viewers, in the map's frame.
struct RegisteredCloud {
  Timestamp stamp;
  std::int64_t scan_seq = 0;
  std::vector<Eigen::Vector3f> points_map;
};

}  // namespace lio
