// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/rest_force.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "lio/filter/preintegration.hpp"
#include "lio/imu/rest.hpp"

namespace lio {
namespace {

// The mean's variance is that of the means of so many parts, divided by their number. Statistics
// (batch means): unlike the spread of samples it sees that a sway lasts for many of them. Chosen:
// nine degrees of freedom over three axes.
constexpr int kNumParts = 4;

double VarianceByParts(std::span<const ImuSample> samples, const Biases& biases) {
  const Timestamp begin = samples.front().stamp;
  const double part_s = SecondsBetween(begin, samples.back().stamp) / kNumParts;
  std::array<Vector3, kNumParts> means;
  Vector3 last = Vector3::Zero();
  Vector3 mean = Vector3::Zero();
  for (std::size_t i = 0; i < kNumParts; ++i) {
    const Timestamp end = begin + Duration::FromSeconds(part_s * static_cast<double>(i + 1));
    const Vector3 velocity = Preintegrate(samples, begin, end, biases, {}).velocity;
    means[i] = (velocity - last) / part_s;
    mean += means[i] / kNumParts;
    last = velocity;
  }
  double sum_sq = 0.0;
  for (const Vector3& part : means) sum_sq += (part - mean).squaredNorm();
  return sum_sq / 3.0 / (kNumParts - 1) / kNumParts;
}

}  // namespace

RestForce MeanForceAtRest(std::span<const ImuSample> samples, Timestamp stamp,
                          const Vector3& gyro_bias) {
  if (samples.empty()) throw std::invalid_argument("MeanForceAtRest: no inertial samples");
  const Timestamp begin = samples.front().stamp;
  const Timestamp end = samples.back().stamp;
  const double span_s = SecondsBetween(begin, end);
  RestForce rest;
  rest.mean_mps2 = samples.front().f_imu_mps2;
  if (span_s <= 0.0) return rest;
  const Biases biases{gyro_bias, Vector3::Zero()};
  const Preintegration whole = Preintegrate(samples, begin, end, biases, {});
  const Preintegration turn =
      Preintegrate(samples, begin, std::clamp(stamp, begin, end), biases, {});
  const Matrix3 R_stamp_begin = turn.rotation.conjugate().toRotationMatrix();
  const Vector3 mean_begin = whole.velocity / span_s;
  rest.mean_mps2 = R_stamp_begin * mean_begin;
  rest.by_gyro_bias = Hat(rest.mean_mps2) * turn.by_bias.block<3, 3>(3, 0) +
                      R_stamp_begin * whole.by_bias.block<3, 3>(6, 0) / span_s;
  // Gravity, and whatever force was constant, is the mean, so that the velocity at the end is that
  // at the beginning.
  rest.velocity_mps =
      whole.rotation.conjugate() * (0.5 * span_s * mean_begin - whole.position / span_s);
  rest.scatter_var = VarianceByParts(samples, biases);
  return rest;
}

RestForce MeanForceUnturned(std::span<const ImuSample> samples, Timestamp stamp) {
  std::vector<ImuSample> still(samples.begin(), samples.end());
  for (ImuSample& sample : still) sample.w_imu_radps.setZero();
  RestForce rest = MeanForceAtRest(still, stamp, Vector3::Zero());
  rest.by_gyro_bias.setZero();
  return rest;
}

double TurnToAndFro(std::span<const ImuSample> samples) {
  const Vector3 mean_radps = Summarise(samples).mean_w_radps;
  Vector3 angle_rad = Vector3::Zero();
  double largest_rad = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double step_s = SecondsBetween(samples[i - 1].stamp, samples[i].stamp);
    angle_rad += step_s * (samples[i].w_imu_radps - mean_radps);
    largest_rad = std::max(largest_rad, angle_rad.norm());
  }
  return largest_rad;
}

double SpreadOfTurnedForce(std::span<const ImuSample> samples) {
  Quaternion R_begin_imu = Quaternion::Identity();
  Vector3 sum = Vector3::Zero();
  Vector3 sum_sq = Vector3::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i > 0) {
      const double step_s = SecondsBetween(samples[i - 1].stamp, samples[i].stamp);
      const Vector3 rate = 0.5 * (samples[i - 1].w_imu_radps + samples[i].w_imu_radps);
      R_begin_imu = R_begin_imu * ExpSo3(step_s * rate);
    }
    const Vector3 force = R_begin_imu * samples[i].f_imu_mps2;
    sum += force;
    sum_sq += force.cwiseAbs2();
  }
  const double num = std::max(1.0, static_cast<double>(samples.size()));
  return std::sqrt(std::max(0.0, (sum_sq / num - (sum / num).cwiseAbs2()).maxCoeff()));
}

}  // namespace lio
