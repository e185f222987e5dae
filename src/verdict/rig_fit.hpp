// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Least squares for what is wrong between lidar and IMU: rotation, lever arm and clock offset, from
// the steps of a MotionRecord. Biases and gravity's direction are estimated beside them.
//
// Let E be the rotation from the true imu axes to those that the rig makes of the lidar's, d what
// the lidar's stamps lack to be in the IMU's clock, l the lever arm that the rig lacks (in imu as
// the rig has it), R and p the matched poses, w and f the samples. Then
//
//   turns   Log(R_k-1^T R_k) = E (turn by the gyro + d (w_k - w_k-1) - bias dt),
//   bends   p'' = R E (f + d f' - bias) + g + (R)'' l,
//
// where '' is the second difference over a span and f is averaged under its triangular weight
// (imu/motion_evidence.hpp). Two spans are used: a long one, whose noise is small, and a short one,
// which sees a walker's steps. Rotation and offset both come from the turns as in hand-eye
// calibration; the lever arm, and the rotation about an axis that the drive turns about, from the
// bends.
//
// Sizes of the errors come from the residuals (their median). The covariance is that of the normal
// equations plus the clustered sandwich with clusters of two seconds (White 1980; Liang and Zeger
// 1986), because errors last. Nothing throws. Cost: some milliseconds a minute of drive.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/imu/imu_convention_parameters.hpp"
#include "lio/verdict/motion_record.hpp"

namespace lio {

struct RigFitParameters {
  // s. A second difference spans so much to each side: two scans at 10 Hz. Chosen.
  double short_span_s = 0.2;
  // s. The same of a second one, for which noise is smaller.
  double long_span_s = MotionEvidenceParameters{}.second_difference_span_s;
  // s. Errors that are farther apart are independent. Chosen: longer than a step of a walker and
  // the lag of the map; with one second KITTI's right rig is blamed
  // (docs/experiments/extrinsic.md).
  double cluster_s = 2.0;
  std::size_t min_steps = 30;  // chosen: three seconds at 10 Hz, twice the parameters
  int num_iterations = 4;      // Gauss-Newton; linear but for the rotation. Chosen
  // Huber's threshold in standard deviations of one axis, for residuals of three. Customary, as in
  // TurnFitParameters.
  double huber = 3.0;
  // Standard deviations before anything is known. The rotation has none.
  double offset_prior_s = 0.2;  // rates are linear in the offset for less. Chosen
  double lever_prior_m = 3.0;   // longer than most vehicles' sensor mounts. Chosen
  double gyro_bias_prior_radps = MotionEvidenceParameters{}.gyro_bias_std_radps;
  double gravity_prior_mps2 = 1.0;  // about 6 deg of tilt of the map. Chosen
};

inline constexpr RigFitParameters kRigFit;

struct RigErrors {
  Quaternion rotation = Quaternion::Identity();  // E
  double offset_s = 0.0;
  Vector3 lever_m = Vector3::Zero();
  Vector3 gyro_bias_radps = Vector3::Zero();
  Vector3 accel_bias_mps2 = Vector3::Zero();
  Vector3 g_map_mps2 = Vector3::Zero();
};

// Indices of the parameters; the rotation's perturbation is on the right of E.
inline constexpr int kRigRotation = 0;
inline constexpr int kRigOffset = 3;
inline constexpr int kRigLever = 4;
inline constexpr int kRigGyroBias = 7;
inline constexpr int kRigAccelBias = 10;
inline constexpr int kRigGravity = 13;
inline constexpr int kNumRigParameters = 16;
using RigVector = Eigen::Matrix<double, kNumRigParameters, 1>;
using RigMatrix = Eigen::Matrix<double, kNumRigParameters, kNumRigParameters>;

// Which of the three errors are estimated; the others stay as they start.
struct FreeErrors {
  bool rotation = true;
  bool offset = true;
  bool lever = true;
};

struct RigFitResult {
  RigErrors errors;
  RigMatrix cov = RigMatrix::Zero();
  int num_clusters = 0;  // time intervals that count as independent
  double cost = 0.0;     // robust, in variances: comparable between fits of one RigFit
};

class RigFit {
 public:
  // `accel_bias_std_mps2`: the rig's. The record is borrowed for the life of this.
  RigFit(const MotionRecord& record, double accel_bias_std_mps2);

  // Too few steps tell nothing.
  [[nodiscard]] bool HasEnough() const;
  // The start: gravity as the forces have it, everything else as given.
  [[nodiscard]] RigErrors StartAt(const Quaternion& rotation) const;
  // The rotation that best maps the gyro's turns to the matched ones (Kabsch), and the matched
  // turns over the gyro's in length. `correlation` is 1 where one explains the other fully.
  struct TurnAlignment {
    Quaternion rotation = Quaternion::Identity();
    double ratio = 1.0;
    double correlation = 0.0;
  };
  [[nodiscard]] TurnAlignment AlignTurns() const;
  // Takes the sizes of the errors from the residuals at `errors`.
  void SetNoiseFrom(const RigErrors& errors);
  [[nodiscard]] RigFitResult Solve(const RigErrors& start, const FreeErrors& free) const;

 private:
  // The second difference at the end of a step.
  struct Bend {
    Timestamp stamp;
    double weight = 0.0;  // below 1, because neighbouring bends share positions
    Vector3 a_map_mps2 = Vector3::Zero();
    Matrix3 rotation_bend = Matrix3::Zero();  // second difference of R_map_imu, 1/s^2
    struct Part {
      double share;    // part of the triangular weight
      Vector3 f_mps2;  // mean specific force under it, in imu, without a further offset
      Vector3 jerk_mps3;
      Matrix3 R_map_imu;  // at the middle of the step
    };
    std::vector<Part> parts;
  };
  using Jacobian = Eigen::Matrix<double, 3, kNumRigParameters>;
  struct Row {
    Timestamp stamp;
    double weight = 1.0;
    Vector3 residual = Vector3::Zero();
    Jacobian jacobian;
  };
  static constexpr std::size_t kNumGroups = 3;  // turns, short bends, long bends

  [[nodiscard]] std::vector<Bend> FindBends(double span_s, int map) const;
  [[nodiscard]] static Row TurnRow(const MotionStep& step, const RigErrors& errors);
  [[nodiscard]] static Row BendRow(const Bend& bend, const RigErrors& errors);
  [[nodiscard]] std::vector<Row> Rows(std::size_t group, const RigErrors& errors) const;
  static void Hold(const FreeErrors& free, Jacobian& jacobian);
  struct Normal;
  [[nodiscard]] Normal Accumulate(const RigErrors& errors, const FreeErrors& free) const;
  void AddPrior(const RigErrors& errors, const FreeErrors& free, Normal& normal) const;

  const MotionRecord& record_;
  double accel_bias_std_mps2_;
  std::array<std::vector<Bend>, 2> bends_;
  // Chosen beginnings: SetNoiseFrom sets them.
  std::array<double, kNumGroups> variances_{1e-6, 0.09, 0.0025};
};

}  // namespace lio
