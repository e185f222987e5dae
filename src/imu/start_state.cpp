// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/start_state.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "lio/filter/pose_update.hpp"
#include "lio/filter/process_model.hpp"

namespace lio {
namespace {

constexpr double kRestVelocityStd_mps = 0.01;
constexpr double kUnknownTiltStd_rad = 1.0;
// Local gravity differs from the configured value by up to 0.03 m/s^2 between equator and poles.
constexpr double kGravityStd_mps2 = 0.02;

// The rotation that takes `up_imu` to world's z, without turning about it more than needed, and
// with the imu's x axis at yaw zero.
Quaternion LevelledRotation(const Vector3& up_imu) {
  const Quaternion tilt = Quaternion::FromTwoVectors(up_imu, Vector3::UnitZ());
  const Vector3 forward = tilt * Vector3::UnitX();
  const double yaw = std::atan2(forward.y(), forward.x());
  return ExpSo3(Vector3(0, 0, -yaw)) * tilt;
}

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

// Tilt is free (about the world's horizontal axes), yaw is zero by definition.
void FreeTilt(Estimate& estimate, double std_rad) {
  const Matrix3 R = estimate.state.T_world_imu.rotation.toRotationMatrix();
  const Vector3 horizontal(std_rad * std_rad, std_rad * std_rad, 0.0);
  estimate.cov.block<3, 3>(kRot, kRot) = R.transpose() * horizontal.asDiagonal() * R;
}

// Mean specific force at rest: f = -R^T g + accel bias, known to the noise of the mean and, along
// the vertical, to how well gravity's strength is known. Ties tilt to the accelerometer's bias.
void FuseMeanForce(Estimate& estimate, const Vector3& mean_f, double noise_var,
                   const Vector3& g_world) {
  const Matrix3 R = estimate.state.T_world_imu.rotation.toRotationMatrix();
  const Vector3 predicted = -R.transpose() * g_world;
  const Vector3 up_imu = R.transpose() * Vector3::UnitZ();
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(3, kStateDim);
  H.middleCols<3>(kRot) = Hat(predicted);
  H.middleCols<3>(kAccelBias) = Matrix3::Identity();
  const Matrix3 noise = noise_var * Matrix3::Identity() +
                        kGravityStd_mps2 * kGravityStd_mps2 * up_imu * up_imu.transpose();
  FuseLinear(estimate, H, mean_f - predicted - estimate.state.accel_bias, noise);
}

void FuseMeanRate(Estimate& estimate, const Vector3& mean_w, double noise_var) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(3, kStateDim);
  H.middleCols<3>(kGyroBias) = Matrix3::Identity();
  FuseLinear(estimate, H, mean_w - estimate.state.gyro_bias, noise_var * Matrix3::Identity());
}

// Variance of a mean over span_s: by the density, or by the spread seen when that is larger.
double MeanVariance(double density, double seen_std, const ImuStatistics& statistics) {
  const double by_density = density * density / std::max(statistics.span_s, 1e-3);
  const double by_spread = seen_std * seen_std / std::max(1, statistics.num_samples);
  return std::max(by_density, by_spread);
}

std::string Describe(const char* how, const Estimate& estimate, bool has_gravity) {
  const Vector3 up = estimate.state.T_world_imu.rotation.conjugate() * Vector3::UnitZ();
  const double tilt_deg = std::acos(std::clamp(up.z(), -1.0, 1.0)) * 180.0 / M_PI;
  char text[160];
  std::snprintf(text, sizeof text, "started %s: imu tilted by %.2f deg, speed %.2f m/s%s", how,
                tilt_deg, estimate.state.v_world_imu.norm(),
                has_gravity ? "" : ", accelerometer without gravity: roll and pitch unknown");
  return text;
}

void AnchorMap(Estimate& estimate) {
  estimate.state.T_map_imu = estimate.state.T_world_imu;
}

// Integrals of the samples from the first pose on, in the imu frame of the first pose.
struct Preintegral {
  Timestamp stamp;
  Quaternion rotation = Quaternion::Identity();
  Vector3 velocity = Vector3::Zero();
  Vector3 position = Vector3::Zero();
};

std::vector<Preintegral> Preintegrate(std::span<const ImuSample> samples, const StampedPoses& poses,
                                      const Vector3& gyro_bias) {
  std::vector<Preintegral> integrals;
  NavState state;
  state.gyro_bias = gyro_bias;
  ImuSample from = InterpolateSample(samples.front(), samples.front(), poses.front().stamp);
  std::size_t next = 0;
  while (next < samples.size() && samples[next].stamp <= poses.front().stamp) {
    from = samples[next++];
  }
  if (next < samples.size()) from = InterpolateSample(from, samples[next], poses.front().stamp);
  from.stamp = poses.front().stamp;
  const auto step_to = [&](const ImuSample& to) {
    state = PropagateState(state, from, to, Vector3::Zero());
    from = to;
  };
  for (const StampedPose& pose : poses) {
    while (next < samples.size() && samples[next].stamp <= pose.stamp) step_to(samples[next++]);
    if (next < samples.size()) step_to(InterpolateSample(from, samples[next], pose.stamp));
    integrals.push_back(
        {pose.stamp, state.T_world_imu.rotation, state.v_world_imu, state.T_world_imu.translation});
  }
  return integrals;
}

// Mean rate error over the window: what turns the integrated rotation into the matched one.
Vector3 GyroBiasFrom(const std::vector<Preintegral>& integrals, const StampedPoses& poses) {
  const Quaternion matched = poses.front().pose.rotation.conjugate() * poses.back().pose.rotation;
  const double span_s = SecondsBetween(poses.front().stamp, poses.back().stamp);
  return LogSo3(matched.conjugate() * integrals.back().rotation) / span_s;
}

}  // namespace

ImuStatistics Summarise(std::span<const ImuSample> samples) {
  ImuStatistics statistics;
  statistics.num_samples = static_cast<int>(samples.size());
  if (samples.empty()) return statistics;
  statistics.span_s = SecondsBetween(samples.front().stamp, samples.back().stamp);
  const auto n = static_cast<double>(samples.size());
  for (const ImuSample& sample : samples) {
    statistics.mean_w_radps += sample.w_imu_radps / n;
    statistics.mean_f_mps2 += sample.f_imu_mps2 / n;
  }
  Vector3 w_sq = Vector3::Zero();
  Vector3 f_sq = Vector3::Zero();
  for (const ImuSample& sample : samples) {
    w_sq += (sample.w_imu_radps - statistics.mean_w_radps).cwiseAbs2() / n;
    f_sq += (sample.f_imu_mps2 - statistics.mean_f_mps2).cwiseAbs2() / n;
  }
  statistics.gyro_std_radps = std::sqrt(w_sq.maxCoeff());
  statistics.accel_std_mps2 = std::sqrt(f_sq.maxCoeff());
  return statistics;
}

bool GravityPresent(const ImuStatistics& statistics, const Rig& rig) {
  if (rig.imu.gravity != GravityInput::kAutomatic) {
    return rig.imu.gravity == GravityInput::kPresent;
  }
  return statistics.mean_f_mps2.norm() > 0.5 * rig.gravity_mps2;
}

StartState StartAtRest(std::span<const ImuSample> samples, Timestamp stamp, const Rig& rig) {
  if (samples.empty()) throw std::invalid_argument("StartAtRest: no inertial samples");
  const ImuStatistics statistics = Summarise(samples);
  const bool has_gravity = GravityPresent(statistics, rig);
  StartState start;
  start.estimate = PriorEstimate(stamp, rig, kRestVelocityStd_mps);
  FuseMeanRate(start.estimate, statistics.mean_w_radps,
               MeanVariance(rig.imu.gyro_noise_density, statistics.gyro_std_radps, statistics));
  const double force_var =
      MeanVariance(rig.imu.accel_noise_density, statistics.accel_std_mps2, statistics);
  if (has_gravity) {
    start.g_world = Vector3(0, 0, -rig.gravity_mps2);
    start.estimate.state.T_world_imu.rotation = LevelledRotation(statistics.mean_f_mps2);
    FreeTilt(start.estimate, kUnknownTiltStd_rad);
  }
  FuseMeanForce(start.estimate, statistics.mean_f_mps2, force_var, start.g_world);
  AnchorMap(start.estimate);
  start.how = Describe("at rest", start.estimate, has_gravity);
  return start;
}

StartState StartMoving(std::span<const ImuSample> samples, const StampedPoses& T_map_imu,
                       const Rig& rig) {
  if (samples.empty() || T_map_imu.size() < 3) {
    throw std::invalid_argument("StartMoving: needs inertial samples and three poses");
  }
  const bool has_gravity = GravityPresent(Summarise(samples), rig);
  std::vector<Preintegral> integrals = Preintegrate(samples, T_map_imu, Vector3::Zero());
  const Vector3 gyro_bias = GyroBiasFrom(integrals, T_map_imu);
  integrals = Preintegrate(samples, T_map_imu, gyro_bias);

  // Positions in the first imu frame: p_k = v t + g t^2 / 2 + (double integral of f). Least squares
  // for v and g; without gravity in the reading g is held at zero.
  constexpr double kMatchStd_m = 0.03;
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
  const Pose T_first_map = T_map_imu.front().pose.Inverse();
  for (std::size_t k = 1; k < T_map_imu.size(); ++k) {
    const double t = SecondsBetween(T_map_imu.front().stamp, T_map_imu[k].stamp);
    const Vector3 y = (T_first_map * T_map_imu[k].pose).translation - integrals[k].position;
    Eigen::Matrix<double, 3, 6> A;
    A << t * Matrix3::Identity(), 0.5 * t * t * Matrix3::Identity();
    normal += A.transpose() * A / (kMatchStd_m * kMatchStd_m);
    right += A.transpose() * y / (kMatchStd_m * kMatchStd_m);
  }
  // The mean force says where gravity is, to within the vehicle's own mean acceleration.
  constexpr double kVehicleAccelStd_mps2 = 1.0;
  const Vector3 g_prior =
      has_gravity ? Vector3(-rig.gravity_mps2 * Summarise(samples).mean_f_mps2.normalized())
                  : Vector3::Zero();
  const double g_prior_std = has_gravity ? kVehicleAccelStd_mps2 : 1e-3;
  normal.bottomRightCorner<3, 3>() += Matrix3::Identity() / (g_prior_std * g_prior_std);
  right.tail<3>() += g_prior / (g_prior_std * g_prior_std);
  const Eigen::Matrix<double, 6, 6> cov = normal.inverse();
  const Eigen::Matrix<double, 6, 1> solution = cov * right;
  const Vector3 v_imu = solution.head<3>();
  const Vector3 g_imu = solution.tail<3>();

  StartState start;
  start.estimate = PriorEstimate(T_map_imu.front().stamp, rig, 0.0);
  Estimate& estimate = start.estimate;
  double tilt_std = 0.0;
  if (has_gravity) {
    start.g_world = Vector3(0, 0, -rig.gravity_mps2);
    estimate.state.T_world_imu.rotation = LevelledRotation(-g_imu);
    tilt_std = std::hypot(std::sqrt(cov(3, 3)), rig.imu.accel_bias_std_mps2) / rig.gravity_mps2;
    FreeTilt(estimate, tilt_std);
  }
  const Matrix3 R = estimate.state.T_world_imu.rotation.toRotationMatrix();
  estimate.state.v_world_imu = R * v_imu;
  estimate.cov.block<3, 3>(kVel, kVel) = cov(0, 0) * Matrix3::Identity();
  estimate.state.gyro_bias = gyro_bias.cwiseMax(-3 * rig.imu.gyro_bias_std_radps)
                                 .cwiseMin(3 * rig.imu.gyro_bias_std_radps);
  AnchorMap(estimate);
  start.in_motion = true;
  start.how = Describe("in motion", estimate, has_gravity);
  return start;
}

}  // namespace lio
