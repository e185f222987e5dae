// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/moving_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "imu/alignment.hpp"
#include "lio/base/chi_square.hpp"
#include "lio/sensor/gap.hpp"

namespace lio {
namespace {

constexpr MovingStartParameters kMovingStart = kInitializationParameters.in_motion;

std::string DataProblem(std::span<const ImuSample> samples, std::span<const MatchedPose> poses,
                        Timestamp from) {
  if (poses.size() < kMovingStart.min_poses) {
    return fmt::format("only {} scans were matched, {} are needed", poses.size(),
                       kMovingStart.min_poses);
  }
  const double span_s = SecondsBetween(from, poses.back().stamp);
  if (span_s < kMovingStart.min_span_s) {
    return fmt::format("{:.2f} s of motion, {:.2f} needed", span_s, kMovingStart.min_span_s);
  }
  Timestamp last = from;
  Duration gap;
  for (const ImuSample& sample : samples) {
    if (sample.stamp <= from || last >= poses.back().stamp) continue;
    gap = std::max(gap, sample.stamp - last);
    last = sample.stamp;
  }
  gap = std::max(gap, poses.back().stamp - last);
  if (gap > kImuGap.unmeasured) {
    return fmt::format("inertial samples are missing for {:.2f} s", gap.Seconds());
  }
  return {};
}

// Returns the poses with the error of scan matching that their covariances do not contain.
std::vector<MatchedPose> Widened(std::span<const MatchedPose> poses) {
  Vector6 floor;
  floor << Vector3::Constant(kMovingStart.pose_std_m * kMovingStart.pose_std_m),
      Vector3::Constant(kMovingStart.pose_std_rad * kMovingStart.pose_std_rad);
  std::vector<MatchedPose> widened(poses.begin(), poses.end());
  for (MatchedPose& pose : widened) pose.cov.diagonal() += floor;
  return widened;
}

// Returns the guess of poses and velocities from the matched poses; the window's first state is the
// first pose taken back by constant velocity.
Alignment Guess(const AlignmentTerms& terms, Timestamp from) {
  const std::span<const MatchedPose> poses = terms.poses;
  const auto velocity_at = [&](std::size_t i) {
    const std::size_t a = i == 0 ? 0 : i - 1;
    const std::size_t b = std::min(i + 1, poses.size() - 1);
    return Vector3((poses[b].T_any_imu.translation - poses[a].T_any_imu.translation) /
                   SecondsBetween(poses[a].stamp, poses[b].stamp));
  };
  Alignment guess;
  const Pose& first = poses.front().T_any_imu;
  guess.states.push_back(
      {first.rotation * terms.motions.front().rotation.conjugate(),
       first.translation - SecondsBetween(from, poses.front().stamp) * velocity_at(0),
       velocity_at(0)});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    guess.states.push_back(
        {poses[i].T_any_imu.rotation, poses[i].T_any_imu.translation, velocity_at(i)});
  }
  // The mean force points up, because the vehicle's own acceleration mostly averages out.
  Vector3 force_sum = Vector3::Zero();
  for (std::size_t i = 0; i < terms.motions.size(); ++i) {
    force_sum += guess.states[i].R_any_imu * terms.motions[i].velocity;
  }
  if (force_sum.norm() > 1e-6) guess.up_any = force_sum.normalized();
  return guess;
}

AlignmentTerms MakeTerms(std::span<const ImuSample> samples, std::span<const MatchedPose> poses,
                         Timestamp from, const Rig& rig, double gravity_mps2) {
  AlignmentTerms terms;
  terms.poses = poses;
  terms.gravity_mps2 = gravity_mps2;
  terms.gyro_bias_std_radps = rig.imu.gyro_bias_std_radps;
  terms.accel_bias_std_mps2 = rig.imu.accel_bias_std_mps2;
  ProcessNoise noise;
  noise.gyro_density = rig.imu.gyro_noise_density;
  noise.accel_density = rig.imu.accel_noise_density;
  Timestamp last = from;
  for (const MatchedPose& pose : poses) {
    terms.motions.push_back(Preintegrate(samples, last, pose.stamp, {}, noise));
    last = pose.stamp;
  }
  return terms;
}

// Returns the root of the median of the squared residuals over that of chi-square: robust to wrong
// matches.
double ResidualRatio(std::vector<double> squares) {
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return std::sqrt(*middle / ChiSquareQuantile6(0.5));
}

// Transforms the first state and its covariance from the frame of the poses to world, which is
// level and in which position and yaw of that state are zero.
//
// Let u = R_any_imu^T up_any be the vertical in imu. The levelled rotation's error d obeys
// u x d = du and u . d = 0 (no yaw), so d = -u x du, where du = u x theta + R_any_imu^T d(up_any)
// and theta is the error of R_any_imu. The velocity in world is R_world_imu R_any_imu^T v_any.
void FillEstimate(const AlignmentResult& aligned, bool has_gravity, double scale_sq,
                  Estimate& estimate) {
  const WindowState& first = aligned.solution.states.front();
  const Matrix3 R_imu_any = first.R_any_imu.conjugate().toRotationMatrix();
  const Vector3 u = R_imu_any * aligned.solution.up_any;
  const Vector3 v_imu = R_imu_any * first.v_any_imu;
  const Quaternion rotation = has_gravity ? LevelledRotation(u) : Quaternion::Identity();
  const Matrix3 R = rotation.toRotationMatrix();

  using Rows = Eigen::Matrix<double, 3, 15>;
  Rows level = Rows::Zero();
  if (has_gravity) {
    level.middleCols<3>(kAlignedRot) = -Hat(u) * Hat(u);
    level.middleCols<3>(kAlignedUp) = -Hat(u) * R_imu_any;
  }
  Rows turn = level;  // error of R_world_imu minus that of R_any_imu
  turn.middleCols<3>(kAlignedRot) -= Matrix3::Identity();
  Rows velocity = -R * Hat(v_imu) * turn;
  velocity.middleCols<3>(kAlignedVel) += R * R_imu_any;

  Eigen::Matrix<double, kStateDim, 15> jacobian = Eigen::Matrix<double, kStateDim, 15>::Zero();
  jacobian.middleRows<3>(kRot) = level;
  jacobian.middleRows<3>(kVel) = velocity;
  jacobian.block<6, 6>(kGyroBias, kAlignedBiases).setIdentity();
  estimate.cov = scale_sq * jacobian * aligned.cov * jacobian.transpose();

  estimate.state.T_world_imu.rotation = rotation;
  estimate.state.v_world_imu = R * v_imu;
  estimate.state.gyro_bias = aligned.solution.biases.gyro;
  estimate.state.accel_bias = aligned.solution.biases.accel;
  estimate.state.T_map_imu = estimate.state.T_world_imu;
}

std::string DisagreementProblem(const AlignmentResult& aligned, double residual_ratio) {
  const std::string how = aligned.converged
                              ? fmt::format("{:.1f} times what is normal", residual_ratio)
                              : std::string("no motion suits both");
  return "scan matching and inertial unit disagree (" + how +
         "): check rig.T_imu_lidar, the IMU's units and axes, and the sensors' clocks";
}

std::string EstimateProblem(const Estimate& estimate, const Rig& rig) {
  const double tilt_std = std::sqrt(estimate.cov.block<3, 3>(kRot, kRot).diagonal().maxCoeff());
  if (!(tilt_std < kMovingStart.max_tilt_std_rad)) {
    return fmt::format("roll and pitch stay unsure by {:.1f} deg", tilt_std * 180.0 / M_PI);
  }
  const double gyro = estimate.state.gyro_bias.cwiseAbs().maxCoeff();
  if (gyro > kMovingStart.max_bias_sigmas * rig.imu.gyro_bias_std_radps) {
    return fmt::format(
        "a gyro bias of {:.3f} rad/s is far beyond rig.imu.gyro_bias_std_radps ({:.3f}): are "
        "its rates in rad/s, its axes those of rig.T_imu_lidar?",
        gyro, rig.imu.gyro_bias_std_radps);
  }
  const double accel = estimate.state.accel_bias.cwiseAbs().maxCoeff();
  if (accel > kMovingStart.max_bias_sigmas * rig.imu.accel_bias_std_mps2) {
    return fmt::format(
        "an accelerometer bias of {:.2f} m/s^2 is far beyond rig.imu.accel_bias_std_mps2 "
        "({:.2f}): is gravity in its reading, and in m/s^2?",
        accel, rig.imu.accel_bias_std_mps2);
  }
  return {};
}

}  // namespace

MovingStart StartMoving(std::span<const ImuSample> samples, std::span<const MatchedPose> poses,
                        Timestamp from, const Rig& rig, bool has_gravity) {
  MovingStart result;
  result.why_not = DataProblem(samples, poses, from);
  if (!result.why_not.empty()) return result;
  const std::vector<MatchedPose> widened = Widened(poses);
  const AlignmentTerms terms =
      MakeTerms(samples, widened, from, rig, has_gravity ? rig.gravity_mps2 : 0.0);
  const AlignmentResult aligned = Align(terms, Guess(terms, from));
  result.residual_ratio = ResidualRatio(aligned.pose_residual_sq);
  if (!aligned.converged || !(result.residual_ratio < kMovingStart.max_residual_ratio)) {
    result.why_not = DisagreementProblem(aligned, result.residual_ratio);
    return result;
  }
  StartState start;
  start.estimate.stamp = from;
  const double scale = std::max(1.0, result.residual_ratio);
  FillEstimate(aligned, has_gravity, scale * scale, start.estimate);
  result.why_not = EstimateProblem(start.estimate, rig);
  if (!result.why_not.empty()) return result;
  if (has_gravity) start.g_world = Vector3(0, 0, -rig.gravity_mps2);
  start.how = DescribeStart("in motion", start.estimate, has_gravity);
  result.start = std::move(start);
  return result;
}

}  // namespace lio
