// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/preintegration.hpp"

#include <algorithm>
#include <stdexcept>

#include "filter/inertial_increment.hpp"

namespace lio {
namespace {

constexpr int kP = 0;
constexpr int kR = 3;
constexpr int kV = 6;

using Matrix9 = Eigen::Matrix<double, 9, 9>;

// Maps the errors before the step (A) and of the biases (B) to the errors after it.
struct Transition {
  Matrix9 A = Matrix9::Identity();
  Eigen::Matrix<double, 9, 6> B = Eigen::Matrix<double, 9, 6>::Zero();
};

Transition MakeTransition(const Matrix3& R, const InertialIncrement& step,
                          const IncrementByBias& by_bias) {
  Transition t;
  t.A.block<3, 3>(kP, kR) = -R * Hat(step.position);
  t.A.block<3, 3>(kP, kV) = step.dt_s * Matrix3::Identity();
  t.A.block<3, 3>(kR, kR) = step.turn.conjugate().toRotationMatrix();
  t.A.block<3, 3>(kV, kR) = -R * Hat(step.velocity);
  t.B.block<3, 3>(kP, 0) = R * by_bias.position_by_gyro;
  t.B.block<3, 3>(kP, 3) = R * by_bias.position_by_accel;
  t.B.block<3, 3>(kR, 0) = by_bias.turn_by_gyro;
  t.B.block<3, 3>(kV, 0) = R * by_bias.velocity_by_gyro;
  t.B.block<3, 3>(kV, 3) = R * by_bias.velocity_by_accel;
  return t;
}

void AddNoise(double dt, const Matrix3& R, const ProcessNoise& noise, Matrix9& cov) {
  const Matrix3 velocity = dt * R * AccelPsd(noise).asDiagonal() * R.transpose();
  cov.block<3, 3>(kP, kP) += dt * dt / 3.0 * velocity;
  cov.block<3, 3>(kP, kV) += 0.5 * dt * velocity;
  cov.block<3, 3>(kV, kP) += 0.5 * dt * velocity;
  cov.block<3, 3>(kV, kV) += velocity;
  cov.block<3, 3>(kR, kR).diagonal() += dt * GyroPsd(noise);
}

void Append(const ImuSample& from, const ImuSample& to, const ProcessNoise& noise,
            Preintegration& sum) {
  IncrementByBias by_bias;
  const InertialIncrement step = MakeIncrement(from, to, sum.gyro_bias, sum.accel_bias, by_bias);
  const Matrix3 R = sum.rotation.toRotationMatrix();
  const Transition t = MakeTransition(R, step, by_bias);
  sum.by_bias = t.A * sum.by_bias + t.B;
  sum.cov = t.A * sum.cov * t.A.transpose();
  AddNoise(step.dt_s, R * step.turn.toRotationMatrix(), noise, sum.cov);
  sum.position += step.dt_s * sum.velocity + R * step.position;
  sum.velocity += R * step.velocity;
  sum.rotation = (sum.rotation * step.turn).normalized();
}

// Returns the sample at `stamp`, between the sample before index `after` and the one there.
ImuSample SampleAt(std::span<const ImuSample> samples, std::size_t after, Timestamp stamp) {
  const std::size_t last = samples.size() - 1;
  const ImuSample& b = samples[std::min(after, last)];
  const ImuSample& a = samples[after == 0 ? 0 : std::min(after - 1, last)];
  return InterpolateSample(a, b, stamp);
}

}  // namespace

Preintegration Preintegrate(std::span<const ImuSample> samples, Timestamp from, Timestamp to,
                            const Biases& biases, const ProcessNoise& noise) {
  if (samples.empty()) throw std::invalid_argument("Preintegrate: no inertial samples");
  if (to < from) throw std::invalid_argument("Preintegrate: ends before it begins");
  Preintegration sum;
  sum.from = from;
  sum.to = to;
  sum.gyro_bias = biases.gyro;
  sum.accel_bias = biases.accel;
  const auto is_not_after = [](Timestamp t, const ImuSample& sample) { return t < sample.stamp; };
  auto next = static_cast<std::size_t>(
      std::upper_bound(samples.begin(), samples.end(), from, is_not_after) - samples.begin());
  ImuSample last = SampleAt(samples, next, from);
  for (; next < samples.size() && samples[next].stamp < to; ++next) {
    Append(last, samples[next], noise, sum);
    last = samples[next];
  }
  Append(last, SampleAt(samples, next, to), noise, sum);
  return sum;
}

}  // namespace lio
