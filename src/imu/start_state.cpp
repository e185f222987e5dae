// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/start_state.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lio/filter/pose_update.hpp"
#include "lio/imu/rest_force.hpp"

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

// The means of a second of rest, and how far they err.
struct RestMeans {
  Vector3 rate_radps;
  double rate_noise_var;  // white noise alone
  double rate_var;        // and what may be a turn, (rad/s)^2
  Vector3 gyro_bias;      // the one by which the force was turned
  RestForce force;
  double force_var;  // (m/s^2)^2
};

// Fuses the mean rate, w = gyro bias + noise, and the mean specific force, f = -R^T g + accel bias.
// The force errs by its noise, along the vertical by the uncertainty of gravity, and by the turn
// that the gyro's bias and noise make of it. A sample of noise at the time t of the span T turns
// the forces before it, so that a mean turns by J m, m = 2 / T^2 times the integral of t n(t),
// where the same constant bias would turn it by J: m has 4/3 of the variance of the mean noise,
// and their covariance is the latter's variance. Correlates tilt and both biases.
void FuseRestMeans(Estimate& estimate, const RestMeans& means, const Vector3& g_world) {
  const NavState& state = estimate.state;
  const Matrix3 R = state.T_world_imu.rotation.toRotationMatrix();
  const Vector3 predicted = -R.transpose() * g_world;
  const Vector3 up_imu = R.transpose() * Vector3::UnitZ();
  const Matrix3& J = means.force.by_gyro_bias;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(6, kStateDim);
  H.block<3, 3>(0, kGyroBias) = Matrix3::Identity();
  H.block<3, 3>(3, kGyroBias) = -J;
  H.block<3, 3>(3, kRot) = Hat(predicted);
  H.block<3, 3>(3, kAccelBias) = Matrix3::Identity();
  Vector6 residual;
  residual << means.rate_radps - state.gyro_bias, means.force.mean_mps2 -
                                                      J * (means.gyro_bias - state.gyro_bias) -
                                                      predicted - state.accel_bias;
  Matrix6 noise;
  noise.topLeftCorner<3, 3>() = means.rate_var * Matrix3::Identity();
  noise.bottomLeftCorner<3, 3>() = -means.rate_noise_var * J;
  noise.topRightCorner<3, 3>() = -means.rate_noise_var * J.transpose();
  noise.bottomRightCorner<3, 3>() =
      means.force_var * Matrix3::Identity() + 4.0 / 3.0 * means.rate_noise_var * J * J.transpose() +
      kRestStart.gravity_std_mps2 * kRestStart.gravity_std_mps2 * up_imu * up_imu.transpose();
  FuseLinear(estimate, H, residual, noise);
}

// Returns the variance of a mean over the span: from the noise density, or from the measured spread
// when that is larger.
double MeanVariance(double density, double seen_std, const ImuStatistics& statistics) {
  const double by_density = density * density / std::max(statistics.span_s, 1e-3);
  const double by_spread = seen_std * seen_std / std::max(1, statistics.num_samples);
  return std::max(by_density, by_spread);
}

// A body that stands on wheels is known not to turn, better than its gyro tells.
bool Turns(std::span<const ImuSample> samples, double noise_angle_var, const ShownMotion& shown) {
  return shown.turn_rad > 0.0 ||
         TurnToAndFro(samples) > kRestStart.min_turn_sigmas * std::sqrt(noise_angle_var);
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
  RestMeans means;
  means.rate_radps = statistics.mean_w_radps;
  means.rate_noise_var = rig.imu.gyro_noise_density * rig.imu.gyro_noise_density / span_s;
  const bool turns = Turns(samples, means.rate_noise_var * span_s * span_s, shown);
  // A body that turns to and fro has also turned by what the scans cannot tell.
  const double turn_std_rad = turns ? std::max(shown.turn_rad, shown.turn_std_rad) : 0.0;
  const double turn_std_radps = turn_std_rad / span_s;
  means.rate_var = MeanVariance(rig.imu.gyro_noise_density, statistics.gyro_std_radps, statistics) +
                   turn_std_radps * turn_std_radps;
  const double bias_var = rig.imu.gyro_bias_std_radps * rig.imu.gyro_bias_std_radps;
  means.gyro_bias = bias_var / (bias_var + means.rate_var) * means.rate_radps;
  means.force =
      turns ? MeanForceAtRest(samples, stamp, means.gyro_bias) : MeanForceUnturned(samples, stamp);
  means.force_var =
      std::max(MeanVariance(rig.imu.accel_noise_density, statistics.accel_std_mps2, statistics),
               means.force.scatter_var);
  start.estimate = PriorEstimate(
      stamp, rig,
      Vector3(kRestStart.velocity_std_mps, shown.shift_m / span_s, means.force.velocity_mps.norm())
          .norm());
  if (has_gravity) {
    start.g_world = Vector3(0, 0, -rig.gravity_mps2);
    start.estimate.state.T_world_imu.rotation = LevelledRotation(means.force.mean_mps2);
    FreeTilt(start.estimate, kRestStart.unknown_tilt_std_rad);
  }
  FuseRestMeans(start.estimate, means, start.g_world);
  if (has_gravity) {  // yaw is zero by definition
    Quaternion& rotation = start.estimate.state.T_world_imu.rotation;
    rotation = LevelledRotation(rotation.conjugate() * Vector3::UnitZ());
  }
  AnchorMap(start.estimate);
  start.how = DescribeStart("at rest", start.estimate, has_gravity);
  return start;
}

}  // namespace lio
