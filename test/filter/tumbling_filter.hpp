// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes a filter of a tumbling body, fed with exact samples and poses.
#pragma once

#include <algorithm>
#include <cmath>

#include "lio/filter/filter_history.hpp"
#include "support/motion.hpp"
#include "support/state_error.hpp"

namespace lio::test {

inline constexpr double kTumbleStep_s = 0.02;

inline HistoryOptions TestOptions() {
  HistoryOptions options;
  options.noise = {.gyro_density = 2e-3,
                   .accel_density = 2e-2,
                   .gyro_bias_walk_density = 1e-4,
                   .accel_bias_walk_density = 1e-3};
  options.g_world = kGravity;
  return options;
}

inline const Motion& TestMotion() {
  static const Motion kMotion = Tumble();
  return kMotion;
}

inline Estimate StartEstimate() {
  const MotionState truth = StateOf(TestMotion(), 0.0);
  Estimate estimate;
  estimate.stamp = StampAt(0.0);
  estimate.state.T_world_imu = estimate.state.T_map_imu = truth.T_world_imu;
  estimate.state.v_world_imu = truth.v_world_imu;
  ErrorVector std;
  std << Vector3::Constant(0.01), Vector3::Constant(0.01), Vector3::Constant(0.1),
      Vector3::Constant(5e-3), Vector3::Constant(0.05), Vector6::Zero(), Vector3::Zero();
  estimate.cov = std.cwiseAbs2().asDiagonal();
  return estimate;
}

inline ImuSample SampleAt(double t_s) {
  return ExactSample(TestMotion(), t_s);
}

inline FilterHistory StartedHistory(const HistoryOptions& options = TestOptions()) {
  return {options, StartEstimate(), SampleAt(0.0)};
}

inline PoseEvent PoseAt(double t_s, const Vector6& error = Vector6::Zero(), double std = 0.02) {
  PoseEvent event;
  event.measurement.T_map_imu = TestMotion()(t_s) * ExpSe3(error);
  event.measurement.cov = std * std * Matrix6::Identity();
  return event;
}

inline void AddImuUpTo(FilterHistory& history, double to_s, double step_s = kTumbleStep_s) {
  const double from_s = SecondsOf(history.head().stamp);
  const auto num_steps = static_cast<int>(std::lround((to_s - from_s) / step_s));
  for (int i = 1; i <= num_steps; ++i) (void)history.AddImu(SampleAt(from_s + i * step_s));
}

inline double Difference(const Estimate& a, const Estimate& b) {
  return std::max(BoxMinus(a.state, b.state).cwiseAbs().maxCoeff(),
                  (a.cov - b.cov).cwiseAbs().maxCoeff());
}

}  // namespace lio::test
