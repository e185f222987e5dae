// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Compares one run of the estimator with the truth: its errors have the same parametrization as its
// covariance.
//
// The estimate's world is level, but its origin and its heading are arbitrary. The truth is
// therefore moved, by a turn about z and a shift only, until it meets the estimate at the first
// row; a tilt of the estimate remains an error. Nothing is level where no gravity was felt, and the
// truth is turned about all axes there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

enum class RunFrame {
  kMap,    // trajectory.tum with covariance.csv: the steady path
  kWorld,  // trajectory_world.tum with covariance_world.csv: always level
  kLevel,  // trajectory_level.tum with covariance_level.csv: steady, and level by the last estimate
};

// Holds the files of a run: poses with their covariances, and rows of registration.csv.
struct RunFiles {
  std::string name;  // folder of the run
  StampedPoses truth;
  StampedPoses estimate;
  std::vector<Matrix6> covariances;   // one per estimate
  std::vector<Timestamp> nis_stamps;  // stamps of the scans that were fused
  std::vector<double> nis;            // NIS of their six-dimensional innovations
  bool has_registration = false;
  bool is_level = true;  // false: a complete run without a level path, which needs gravity
};

// Reads DIR's two files of `frame` and, when it exists, DIR/registration.csv. The truth is
// DIR/`truth` when that exists, else the file `truth`. Throws std::runtime_error that names file
// and line, also when the two tables' stamps differ. Rows that only one of the two has at its end
// are left out where there is no stats.json, which a killed run lacks; stderr says so.
[[nodiscard]] RunFiles LoadRun(const std::filesystem::path& dir, const std::filesystem::path& truth,
                               RunFrame frame = RunFrame::kMap);

struct RunInstant {
  double time_s = 0;  // since the run's first row
  Vector6 error;      // position in world [m]; rotation d, R_true = R_estimate Exp(d) [rad]
  Matrix6 cov;        // in the order of `error`
  Matrix6 cov_world;  // its rotation block is in world axes, which separates tilt and yaw
  Vector3 rotation_error_world;
};

// The error of roll and pitch against true gravity, in standard deviations: the square root of
// e' C^-1 e of the two angles, so that a consistent one is above s in exp(-s^2/2) of the instants,
// 0.2 % at 3.5.
struct TiltSample {
  double time_s = 0;  // since the run's first row
  double sigmas = 0;
};

struct NisSample {
  double time_s = 0;  // since the run's first row
  double nis = 0;
};

struct RunErrors {
  std::string name;
  std::vector<RunInstant> instants;
  std::vector<TiltSample> tilts;  // the first row has one, too: no alignment takes it away
  std::vector<NisSample> nis;
  double truth_period_s = 0;  // median period
  int num_without_truth = 0;  // rows that the truth does not cover
  int num_singular = 0;       // rows left out because their covariance cannot be inverted
};

// Leaves out the first row, whose error is zero by construction but for its tilt. Throws
// std::runtime_error when no row is left.
[[nodiscard]] RunErrors ComputeRunErrors(const RunFiles& run);

// Returns the turn about z and shift that carry `truth` onto `estimate` as far as such a motion
// can: the rotation left between them has no vertical part.
[[nodiscard]] Pose LevelAlignment(const Pose& truth, const Pose& estimate);

}  // namespace lio
