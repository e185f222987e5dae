// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// One run of the estimator against the truth: its errors in the chart of its own covariance.
//
// The estimate's world is level, but where it starts and how it is turned about the vertical is its
// own choice. So the truth is moved, by a turn about z and a shift only, until it meets the
// estimate at the first row; a tilt of the estimate stays an error, as it must.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/sensor/stamped_pose.hpp"

namespace lio {

enum class RunFrame {
  kMap,    // trajectory.tum by covariance.csv: the steady path
  kWorld,  // trajectory_world.tum by covariance_world.csv: level at all times
};

// What a run left: poses with their covariances, and rows of registration.csv.
struct RunFiles {
  std::string name;  // the folder
  StampedPoses truth;
  StampedPoses estimate;
  std::vector<Matrix6> covariances;   // one an estimate
  std::vector<Timestamp> nis_stamps;  // scans that were fused
  std::vector<double> nis;            // of their six-dimensional innovations
  bool has_registration = false;
};

// Reads DIR's two files of `frame` and, where there is one, DIR/registration.csv. The truth is
// DIR/`truth` when that exists, else the file `truth`. Throws std::runtime_error naming file and
// line, also when the two tables' stamps differ.
RunFiles LoadRun(const std::filesystem::path& dir, const std::filesystem::path& truth,
                 RunFrame frame = RunFrame::kMap);

struct RunInstant {
  double time_s = 0;  // since the run's first row
  Vector6 error;      // position in world [m]; rotation d, R_true = R_estimate Exp(d) [rad]
  Matrix6 cov;        // the same order
  Matrix6 cov_world;  // its rotation block turned into world: tilt and yaw apart
  Vector3 rotation_error_world;
};

struct NisSample {
  double time_s = 0;  // since the run's first row
  double nis = 0;
};

struct RunErrors {
  std::string name;
  std::vector<RunInstant> instants;
  std::vector<NisSample> nis;
  double truth_period_s = 0;  // median
  int num_without_truth = 0;  // rows that the truth does not cover
  int num_singular = 0;       // rows whose covariance cannot be inverted: left out
};

// The first row is left out: it has no error by construction. Throws std::runtime_error when no
// row is left.
RunErrors ComputeRunErrors(const RunFiles& run);

// The turn about z and shift that carries `truth` onto `estimate` as far as such a motion can: the
// rotation left between them has no vertical part.
Pose LevelAlignment(const Pose& truth, const Pose& estimate);

}  // namespace lio
