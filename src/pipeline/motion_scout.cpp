// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/motion_scout.hpp"

#include <algorithm>

namespace lio {
namespace {

constexpr Duration kStep{10'000'000};
constexpr double kAccelDensity = 1.5;      // m/s^2/sqrt(Hz): 0.5 m/s in a sweep of 0.1 s
constexpr double kTurnAccelDensity = 1.0;  // rad/s^2/sqrt(Hz): 0.3 rad/s in a sweep
constexpr double kStartVelocityStd_mps = 15.0;
constexpr double kStartTurnRateStd_radps = 1.0;

HistoryOptions ScoutOptions(double span_s, double nis_limit) {
  HistoryOptions options;
  options.noise.accel_density = kAccelDensity;
  options.noise.gyro_bias_walk_density = kTurnAccelDensity;
  options.g_world = Vector3::Zero();
  options.span_s = span_s;
  options.nis_limit = nis_limit;
  options.gap_s = 1e9;  // its samples never have a gap
  return options;
}

Estimate ScoutStart(Timestamp start) {
  Estimate estimate;
  estimate.stamp = start;
  const Matrix3 identity = Matrix3::Identity();
  estimate.cov.block<3, 3>(kVel, kVel) = kStartVelocityStd_mps * kStartVelocityStd_mps * identity;
  estimate.cov.block<3, 3>(kGyroBias, kGyroBias) =
      kStartTurnRateStd_radps * kStartTurnRateStd_radps * identity;
  return estimate;
}

ImuSample Nothing(Timestamp stamp) {
  ImuSample sample;
  sample.stamp = stamp;
  return sample;
}

}  // namespace

MotionScout::MotionScout(Timestamp start, double span_s, double nis_limit)
    : history_(ScoutOptions(span_s, nis_limit), ScoutStart(start), Nothing(start)) {}

void MotionScout::AdvanceTo(Timestamp stamp) {
  Timestamp at = history_.head().stamp;
  while (at < stamp) {
    at = std::min(at + kStep, stamp);
    history_.AddImu(Nothing(at));
  }
}

}  // namespace lio
