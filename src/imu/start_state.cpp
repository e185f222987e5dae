// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/start_state.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lio/filter/pose_update.hpp"

namespace lio {
namespace {

constexpr RestStartParameters kRestStart = kInitializationParameters.at_rest;

Estimate PriorEstimate(Timestamp stamp, const Rig& rig, double velocity_std_mps) {
  Estimate estimate;
  estimate.stamp = stamp;
  const auto set = [&](int at, double std) {
    estimate.cov.block<3, 3>(at, at) = std * std * Matrix3::Identity();
  };
  set(kVel, velocity_std_mps);
  set(kGyroBias, rig.imu.gyro_bias_std_radps);
  set(kAccelBias, rig.imu.accel_bias_std_mps2);
  return estimate;
}

// Makes the tilt unknown: variance about the world's horizontal axes, none about the vertical.
void FreeTilt(Estimate& estimate, double std_rad) {
  const Matrix3 R = estimate.state.T_world_imu.rotation.toRotationMatrix();
  const Vector3 horizontal(std_rad * std_rad, std_rad * std_rad, 0.0);
  estimate.cov.block<3, 3>(kRot, kRot) = R.transpose() * horizontal.asDiagonal() * R;
}

// Fuses the mean specific force at rest, f = -R^T g + accel bias. Its error is the noise of the
// mean and, along the vertical, the uncertainty of gravity. Correlates tilt and the accelerometer's
// bias.
void FuseMeanForce(Estimate& estimate, const Vector3& mean_f, double noise_var,
                   const Vector3& g_world) {
  const Matrix3 R = estimate.state.T_world_imu.rotation.toRotationMatrix();
  const Vector3 predicted = -R.transpose() * g_world;
  const Vector3 up_imu = R.transpose() * Vector3::UnitZ();
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(3, kStateDim);
  H.middleCols<3>(kRot) = Hat(predicted);
  H.middleCols<3>(kAccelBias) = Matrix3::Identity();
  const Matrix3 noise = noise_var * Matrix3::Identity() + kRestStart.gravity_std_mps2 *
                                                              kRestStart.gravity_std_mps2 * up_imu *
                                                              up_imu.transpose();
  FuseLinear(estimate, H, mean_f - predicted - estimate.state.accel_bias, noise);
}

void FuseMeanRate(Estimate& estimate, const Vector3& mean_w, double noise_var) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(3, kStateDim);
  H.middleCols<3>(kGyroBias) = Matrix3::Identity();
  FuseLinear(estimate, H, mean_w - estimate.state.gyro_bias, noise_var * Matrix3::Identity());
}

// Returns the variance of a mean over the span: from the noise density, or from the measured spread
// when that is larger.
double MeanVariance(double density, double seen_std, const ImuStatistics& statistics) {
  const double by_density = density * density / std::max(statistics.span_s, 1e-3);
  const double by_spread = seen_std * seen_std / std::max(1, statistics.num_samples);
  return std::max(by_density, by_spread);
}

// Adds the uncertainty of the continued position, which includes `coasting_std_m`, and yaw. An
// error of yaw turns the velocity along.
void AddPlacingError(const LastFix& earlier, double coasting_std_m, Estimate& estimate) {
  const NavState& state = estimate.state;
  const Matrix3 R_then = earlier.T_world_imu.rotation.toRotationMatrix();
  const Matrix3 rotation_cov_world =
      R_then * earlier.pose_cov.bottomRightCorner<3, 3>() * R_then.transpose();
  const double yaw_var = rotation_cov_world(2, 2) + kPlacedStd_rad * kPlacedStd_rad;
  ErrorVector by_yaw = ErrorVector::Zero();
  by_yaw.segment<3>(kRot) = state.T_world_imu.rotation.conjugate() * Vector3::UnitZ();
  by_yaw.segment<3>(kVel) = Vector3::UnitZ().cross(state.v_world_imu);
  estimate.cov += yaw_var * by_yaw * by_yaw.transpose();
  estimate.cov.block<3, 3>(kPos, kPos) += earlier.pose_cov.topLeftCorner<3, 3>();
  estimate.cov.diagonal().segment<3>(kPos).array() +=
      kPlacedStd_m * kPlacedStd_m + coasting_std_m * coasting_std_m;
}

void AnchorMap(Estimate& estimate) {
  estimate.state.T_map_imu = estimate.state.T_world_imu;
}

}  // namespace

Quaternion LevelledRotation(const Vector3& up_imu) {
  const Quaternion tilt = Quaternion::FromTwoVectors(up_imu, Vector3::UnitZ());
  return ExpSo3(Vector3(0, 0, -YawOf(tilt))) * tilt;
}

double CoastedSince_s(const LastFix& earlier, Timestamp now) {
  return std::clamp(SecondsBetween(earlier.stamp, now), 0.0, kRestStart.max_coast_s);
}

void Level(const Quaternion& R_level_imu, LastFix& point) {
  const double yaw_rad = YawOf(point.T_world_imu.rotation) - YawOf(R_level_imu);
  const Quaternion rotation = ExpSo3(Vector3(0, 0, yaw_rad)) * R_level_imu;
  point.v_world_imu = rotation * (point.T_world_imu.rotation.conjugate() * point.v_world_imu);
  point.T_world_imu.rotation = rotation;
}

void PlaceInWorld(const LastFix& earlier, bool has_gravity, Estimate& estimate) {
  NavState& state = estimate.state;
  const Quaternion& R_then = earlier.T_world_imu.rotation;
  const Quaternion& R_now = state.T_world_imu.rotation;
  const Quaternion turn = has_gravity ? ExpSo3(Vector3(0, 0, YawOf(R_then) - YawOf(R_now)))
                                      : R_then * R_now.conjugate();
  state.v_world_imu = turn * state.v_world_imu;
  const double since_s = CoastedSince_s(earlier, estimate.stamp);
  const Vector3 position =
      earlier.T_world_imu.translation + 0.5 * since_s * (earlier.v_world_imu + state.v_world_imu);
  const Pose placed{turn, position - turn * state.T_world_imu.translation};
  state.T_world_imu = placed * state.T_world_imu;
  state.T_map_imu = earlier.T_map_imu * earlier.T_world_imu.Inverse() * state.T_world_imu;
  ErrorMatrix by_turn = ErrorMatrix::Identity();
  by_turn.block<3, 3>(kPos, kPos) = turn.toRotationMatrix();
  by_turn.block<3, 3>(kVel, kVel) = turn.toRotationMatrix();
  estimate.cov = by_turn * estimate.cov * by_turn.transpose();
  AddPlacingError(earlier, 0.5 * since_s * (state.v_world_imu - earlier.v_world_imu).norm(),
                  estimate);
}

std::string DescribeStart(const char* how, const Estimate& estimate, bool has_gravity) {
  const Vector3 up = estimate.state.T_world_imu.rotation.conjugate() * Vector3::UnitZ();
  const double tilt_deg = std::acos(std::clamp(up.z(), -1.0, 1.0)) * 180.0 / M_PI;
  return fmt::format("started {}: imu tilted by {:.2f} deg, speed {:.2f} m/s{}", how, tilt_deg,
                     estimate.state.v_world_imu.norm(),
                     has_gravity ? "" : ", accelerometer without gravity: roll and pitch unknown");
}

bool GravityPresent(const ImuStatistics& statistics, const Rig& rig) {
  if (rig.imu.gravity != GravityInput::kAutomatic) {
    return rig.imu.gravity == GravityInput::kPresent;
  }
  return statistics.mean_f_mps2.norm() > kRestStart.min_gravity_share * rig.gravity_mps2;
}

StartState StartAtRest(std::span<const ImuSample> samples, Timestamp stamp, const Rig& rig,
                       const ShownMotion& shown) {
  if (samples.empty()) throw std::invalid_argument("StartAtRest: no inertial samples");
  const ImuStatistics statistics = Summarise(samples);
  const bool has_gravity = GravityPresent(statistics, rig);
  StartState start;
  const double span_s = std::max(statistics.span_s, 1e-3);
  const double turn_std_radps = shown.turn_rad / span_s;
  start.estimate =
      PriorEstimate(stamp, rig, std::hypot(kRestStart.velocity_std_mps, shown.shift_m / span_s));
  FuseMeanRate(start.estimate, statistics.mean_w_radps,
               MeanVariance(rig.imu.gyro_noise_density, statistics.gyro_std_radps, statistics) +
                   turn_std_radps * turn_std_radps);
  const double force_var =
      MeanVariance(rig.imu.accel_noise_density, statistics.accel_std_mps2, statistics);
  if (has_gravity) {
    start.g_world = Vector3(0, 0, -rig.gravity_mps2);
    start.estimate.state.T_world_imu.rotation = LevelledRotation(statistics.mean_f_mps2);
    FreeTilt(start.estimate, kRestStart.unknown_tilt_std_rad);
  }
  FuseMeanForce(start.estimate, statistics.mean_f_mps2, force_var, start.g_world);
  AnchorMap(start.estimate);
  start.how = DescribeStart("at rest", start.estimate, has_gravity);
  return start;
}

}  // namespace lio
