// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives analytic motions for tests: each of x y z roll pitch yaw is a parabola plus sines of time,
// with exact derivatives, and the samples of an IMU on it.
#pragma once

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/sensor/imu_sample.hpp"
#include "support/stamp_from_zero.hpp"

namespace lio::test {

struct Wave {
  double amplitude = 0.0;
  double rate_radps = 0.0;
  double phase_rad = 0.0;
};

struct Coordinate {
  double start = 0.0;
  double speed = 0.0;
  double accel = 0.0;
  std::vector<Wave> waves;

  // Returns the value with its first and second derivative.
  std::array<double, 3> At(double t) const {
    std::array<double, 3> x{start + speed * t + 0.5 * accel * t * t, speed + accel * t, accel};
    for (const Wave& wave : waves) {
      const double angle = wave.rate_radps * t + wave.phase_rad;
      x[0] += wave.amplitude * std::sin(angle);
      x[1] += wave.amplitude * wave.rate_radps * std::cos(angle);
      x[2] -= wave.amplitude * wave.rate_radps * wave.rate_radps * std::sin(angle);
    }
    return x;
  }
};

struct MotionPoint {
  Pose T_world_imu;
  Vector3 v_world = Vector3::Zero();  // m/s
  Vector3 a_world = Vector3::Zero();  // m/s^2
  Vector3 w_imu = Vector3::Zero();    // rad/s
};

// R = Rz(yaw) Ry(pitch) Rx(roll).
struct SmoothMotion {
  Coordinate x, y, z, roll, pitch, yaw;

  MotionPoint At(double t) const {
    const auto px = x.At(t), py = y.At(t), pz = z.At(t);
    const auto r = roll.At(t), p = pitch.At(t), h = yaw.At(t);
    MotionPoint point;
    point.T_world_imu.translation = {px[0], py[0], pz[0]};
    point.v_world = {px[1], py[1], pz[1]};
    point.a_world = {px[2], py[2], pz[2]};
    const Quaternion Rx = ExpSo3(Vector3(r[0], 0, 0));
    const Quaternion Ry = ExpSo3(Vector3(0, p[0], 0));
    point.T_world_imu.rotation = ExpSo3(Vector3(0, 0, h[0])) * Ry * Rx;
    point.w_imu = Vector3(r[1], 0, 0) + Rx.conjugate() * Vector3(0, p[1], 0) +
                  Rx.conjugate() * (Ry.conjugate() * Vector3(0, 0, h[1]));
    return point;
  }
};

// Holds the errors of an IMU; densities are per axis.
struct ImuErrors {
  Vector3 gyro_bias = Vector3::Zero();
  Vector3 accel_bias = Vector3::Zero();
  double gyro_density = 0.0;
  double accel_density = 0.0;
};

inline constexpr double kGravity_mps2 = 9.80665;

inline Vector3 NormalVector(std::mt19937_64& random, double std) {
  std::normal_distribution<double> normal(0.0, std);
  const double a = normal(random);
  const double b = normal(random);
  return {a, b, normal(random)};
}

// Returns samples at rate_hz from `from_s` to `to_s`; time 0 is stamp 0.
inline std::vector<ImuSample> ReadImu(const SmoothMotion& motion, double from_s, double to_s,
                                      double rate_hz, const ImuErrors& errors,
                                      std::mt19937_64& random) {
  std::vector<ImuSample> samples;
  const auto first = static_cast<int>(std::ceil(from_s * rate_hz - 1e-9));
  const double to_sample = std::sqrt(rate_hz);
  for (int i = first; i <= to_s * rate_hz + 1e-9; ++i) {
    const double t = i / rate_hz;
    const MotionPoint point = motion.At(t);
    ImuSample sample;
    sample.stamp = StampFromZero(t);
    sample.w_imu_radps =
        point.w_imu + errors.gyro_bias + NormalVector(random, errors.gyro_density * to_sample);
    sample.f_imu_mps2 =
        point.T_world_imu.rotation.conjugate() * (point.a_world + Vector3(0, 0, kGravity_mps2)) +
        errors.accel_bias + NormalVector(random, errors.accel_density * to_sample);
    samples.push_back(sample);
  }
  return samples;
}

// Returns the motion of a car that turns while it accelerates, on springs.
inline SmoothMotion CarMotion() {
  SmoothMotion motion;
  motion.x = {1.0, 8.0, 0.5, {{0.02, 9.0, 0.3}}};
  motion.y = {-2.0, 1.0, 0.8, {{0.02, 8.0, 1.3}}};
  motion.z = {0.5, 0.05, 0.0, {{0.03, 10.0, 0.7}}};
  motion.roll = {0.02, 0.0, 0.0, {{0.015, 7.0, 0.1}}};
  motion.pitch = {-0.03, 0.0, 0.0, {{0.012, 9.0, 2.1}}};
  motion.yaw = {0.4, 0.25, -0.05, {{0.01, 3.0, 0.0}}};
  return motion;
}

// Returns the motion of a hand-held sensor.
inline SmoothMotion WalkMotion() {
  SmoothMotion motion;
  motion.x = {0.0, 1.3, 0.0, {{0.03, 11.3, 0.3}}};
  motion.y = {0.0, 0.3, 0.1, {{0.04, 5.65, 1.3}}};
  motion.z = {1.2, 0.0, 0.0, {{0.025, 11.3, 0.7}}};
  motion.roll = {0.15, 0.0, 0.0, {{0.05, 5.65, 0.1}}};
  motion.pitch = {-0.2, 0.0, 0.0, {{0.04, 11.3, 2.1}}};
  motion.yaw = {1.9, 0.4, 0.0, {{0.08, 5.65, 0.0}}};
  return motion;
}

}  // namespace lio::test
