// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "support/motion.hpp"

#include <cmath>

namespace lio::test {
namespace {

constexpr double kStep_s =
    2e-3;  // step of the differences, at which truncation and rounding errors are alike

Quaternion FromYawPitchRoll(double yaw, double pitch, double roll) {
  return ExpSo3(Vector3(0, 0, yaw)) * ExpSo3(Vector3(0, pitch, 0)) * ExpSo3(Vector3(roll, 0, 0));
}

// Returns the metres driven since the start: the speed ramps up with continuous jerk, then stays
// constant.
double Driven(double t_s, double rest_s) {
  constexpr double kSpeed_mps = 8.0;
  constexpr double kRamp_s = 4.0;
  const double u = (t_s - rest_s) / kRamp_s;
  if (u <= 0) return 0.0;
  if (u >= 1) return kSpeed_mps * kRamp_s * (u - 0.5);
  const double u4 = u * u * u * u;
  return kSpeed_mps * kRamp_s * u4 * (u * u - 3.0 * u + 2.5);
}

Pose OnRoad(double driven_m, double swing_m) {
  constexpr double kWave_radpm = 0.08;  // wave number of the road: it turns by 0.35 rad every 39 m
  constexpr double kSway_rad = 0.017;
  const double along = kWave_radpm * driven_m;
  Pose pose;
  pose.translation = Vector3(driven_m, swing_m * (1.0 - std::cos(along)), 0.0);
  const double yaw = std::atan(swing_m * kWave_radpm * std::sin(along));
  pose.rotation = FromYawPitchRoll(yaw, kSway_rad * std::sin(0.33 * driven_m),
                                   kSway_rad * std::sin(0.21 * driven_m));
  return pose;
}

}  // namespace

MotionState StateOf(const Motion& motion, double t_s) {
  const auto at = [&](int steps) { return motion(t_s + steps * kStep_s); };
  const Pose before2 = at(-2), before = at(-1), now = at(0), after = at(1), after2 = at(2);
  MotionState state;
  state.T_world_imu = now;
  state.v_world_imu = (8.0 * (after.translation - before.translation) -
                       (after2.translation - before2.translation)) /
                      (12.0 * kStep_s);
  state.a_world_imu = (16.0 * (after.translation + before.translation) - 30.0 * now.translation -
                       (after2.translation + before2.translation)) /
                      (12.0 * kStep_s * kStep_s);
  const auto turned = [&](const Pose& pose) {
    return LogSo3(now.rotation.conjugate() * pose.rotation);
  };
  state.w_imu = (8.0 * (turned(after) - turned(before)) - (turned(after2) - turned(before2))) /
                (12.0 * kStep_s);
  return state;
}

ImuSample ExactSample(const Motion& motion, double t_s, const Vector3& g_world) {
  const MotionState state = StateOf(motion, t_s);
  ImuSample sample;
  sample.stamp = StampAt(t_s);
  sample.w_imu_radps = state.w_imu;
  sample.f_imu_mps2 = state.T_world_imu.rotation.conjugate() * (state.a_world_imu - g_world);
  return sample;
}

std::vector<ImuSample> ExactSamples(const Motion& motion, double from_s, double to_s, double step_s,
                                    const Vector3& g_world) {
  std::vector<ImuSample> samples;
  const auto num_steps = static_cast<int>(std::lround((to_s - from_s) / step_s));
  for (int i = 0; i <= num_steps; ++i) {
    samples.push_back(ExactSample(motion, from_s + i * step_s, g_world));
  }
  return samples;
}

Motion Tumble() {
  return [](double t) {
    Pose pose;
    pose.translation = Vector3(2.0 * std::sin(0.9 * t), 1.5 * std::cos(0.7 * t) + 0.5 * t,
                               0.8 * std::sin(1.3 * t + 0.4));
    pose.rotation =
        FromYawPitchRoll(0.8 * t, 0.5 * std::sin(1.1 * t), 0.4 * std::sin(0.8 * t + 1.0));
    return pose;
  };
}

Motion WindingDrive(double rest_s) {
  return [rest_s](double t) { return OnRoad(Driven(t, rest_s), 5.0); };
}

Motion StraightDrive(double rest_s) {
  return [rest_s](double t) { return OnRoad(Driven(t, rest_s), 0.0); };
}

}  // namespace lio::test
