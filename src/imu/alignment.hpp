// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Solves the least squares of the initialization in motion (moving_start.hpp): states of a window
// from matched poses and inertial samples, in one fixed frame, "any", in which gravity's direction
// is unknown. Preintegration: Forster et al., TRO 2017. Nothing throws.
#pragma once

#include <span>
#include <vector>

#include "lio/filter/preintegration.hpp"
#include "lio/imu/moving_start.hpp"

namespace lio {

struct WindowState {
  Quaternion R_any_imu = Quaternion::Identity();
  Vector3 p_any_imu = Vector3::Zero();  // m
  Vector3 v_any_imu = Vector3::Zero();  // m/s
};

struct Alignment {
  std::vector<WindowState> states;  // one more than poses: the first is where the window begins
  Biases biases;
  Vector3 up_any = Vector3::UnitZ();  // direction against gravity, unit
};

struct AlignmentTerms {
  std::span<const MatchedPose> poses;
  std::vector<Preintegration> motions;  // from state i to i + 1
  double gravity_mps2 = 0.0;            // 0: the measured forces contain none
  double gyro_bias_std_radps = 0.0;
  double accel_bias_std_mps2 = 0.0;
};

// The first state's covariance has this order, 3 each: rotation (rad, right), velocity (m/s, any),
// gyro bias (rad/s), accel bias (m/s^2), up_any (rank 2: its length is fixed).
inline constexpr int kAlignedRot = 0;
inline constexpr int kAlignedVel = 3;
inline constexpr int kAlignedBiases = 6;
inline constexpr int kAlignedUp = 12;
using AlignedCov = Eigen::Matrix<double, 15, 15>;

struct AlignmentResult {
  bool converged = false;
  Alignment solution;
  std::vector<double> pose_residual_sq;  // squared normalized residual of each pose, 6 rows
  AlignedCov cov = AlignedCov::Zero();   // only when converged; NaN when not determined
};

// Solves from a guess that may be several degrees and metres per second off.
AlignmentResult Align(const AlignmentTerms& terms, const Alignment& guess);

}  // namespace lio
