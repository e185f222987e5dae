// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/preintegration.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "support/numeric_jacobian.hpp"
#include "support/smooth_motion.hpp"

namespace lio {
namespace {

using test::CarMotion;
using test::MotionPoint;
using test::ReadImu;
using test::SmoothMotion;
using test::WalkMotion;
using Vector9 = Eigen::Matrix<double, 9, 1>;

const Vector3 kG(0, 0, -test::kGravity_mps2);

Timestamp At(double t_s) {
  return Timestamp{} + Duration::FromSeconds(t_s);
}

// Returns the difference of two results in error order; b is the reference.
Vector9 Difference(const Preintegration& a, const Preintegration& b) {
  Vector9 d;
  d << a.position - b.position, LogSo3(b.rotation.conjugate() * a.rotation),
      a.velocity - b.velocity;
  return d;
}

// Returns the true relative motion over an interval.
Preintegration Truth(const SmoothMotion& motion, double from_s, double to_s) {
  const MotionPoint a = motion.At(from_s);
  const MotionPoint b = motion.At(to_s);
  const double t = to_s - from_s;
  const Quaternion to_imu = a.T_world_imu.rotation.conjugate();
  Preintegration truth;
  truth.rotation = to_imu * b.T_world_imu.rotation;
  truth.velocity = to_imu * (b.v_world - a.v_world - t * kG);
  truth.position = to_imu * (b.T_world_imu.translation - a.T_world_imu.translation - t * a.v_world -
                             0.5 * t * t * kG);
  return truth;
}

Preintegration Exact(const SmoothMotion& motion, double from_s, double to_s, double rate_hz) {
  std::mt19937_64 random(1);
  const auto samples = ReadImu(motion, from_s - 0.1, to_s + 0.1, rate_hz, {}, random);
  return Preintegrate(samples, At(from_s), At(to_s), {}, {});
}

TEST(Preintegration, ErrorFallsByFourWhenTheRateDoubles) {
  for (const SmoothMotion& motion : {CarMotion(), WalkMotion()}) {
    const Preintegration truth = Truth(motion, 0.013, 1.007);
    const double coarse = Difference(Exact(motion, 0.013, 1.007, 200), truth).norm();
    const double fine = Difference(Exact(motion, 0.013, 1.007, 400), truth).norm();
    EXPECT_LT(fine, 2e-4);
    EXPECT_NEAR(coarse / fine, 4.0, 0.6) << coarse << " " << fine;
  }
}

TEST(Preintegration, NeighbouringIntervalsComposeToTheWhole) {
  const SmoothMotion motion = WalkMotion();
  // On a sample's stamp both halves use the same samples as the whole.
  const Preintegration whole = Exact(motion, 0.1, 1.1, 100);
  const Preintegration a = Exact(motion, 0.1, 0.5, 100);
  const Preintegration b = Exact(motion, 0.5, 1.1, 100);
  Preintegration sum;
  sum.rotation = a.rotation * b.rotation;
  sum.velocity = a.velocity + a.rotation * b.velocity;
  sum.position = a.position + b.span_s() * a.velocity + a.rotation * b.position;
  EXPECT_LT(Difference(sum, whole).norm(), 1e-12);
}

TEST(Preintegration, AgreesWithTheFiltersPropagation) {
  const SmoothMotion motion = CarMotion();
  std::mt19937_64 random(5);
  const auto samples = ReadImu(motion, 0.0, 0.5, 100, {}, random);
  NavState state;
  state.T_world_imu = motion.At(0.0).T_world_imu;
  state.v_world_imu = motion.At(0.0).v_world;
  state.gyro_bias = {0.01, -0.02, 0.005};
  state.accel_bias = {0.1, 0.2, -0.1};
  const NavState start = state;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    state = PropagateState(state, samples[i - 1], samples[i], kG);
  }
  const Preintegration sum =
      Preintegrate(samples, At(0.0), At(0.5), {start.gyro_bias, start.accel_bias}, {});
  const Quaternion to_imu = start.T_world_imu.rotation.conjugate();
  EXPECT_LT(LogSo3((to_imu * state.T_world_imu.rotation).conjugate() * sum.rotation).norm(), 1e-12);
  EXPECT_LT((to_imu * (state.v_world_imu - start.v_world_imu - 0.5 * kG) - sum.velocity).norm(),
            1e-12);
  const Vector3 shift = state.T_world_imu.translation - start.T_world_imu.translation -
                        0.5 * start.v_world_imu - 0.125 * kG;
  EXPECT_LT((to_imu * shift - sum.position).norm(), 1e-12);
}

TEST(Preintegration, BiasJacobianIsThatOfNumericDifferences) {
  std::mt19937_64 random(2);
  for (const SmoothMotion& motion : {CarMotion(), WalkMotion()}) {
    const auto samples = ReadImu(motion, 0.0, 0.6, 100, {}, random);
    Eigen::VectorXd at(6);
    at << 0.01, -0.02, 0.015, 0.1, -0.2, 0.05;
    const auto run = [&](const Eigen::VectorXd& biases) {
      return Preintegrate(samples, At(0.043), At(0.522), {biases.head<3>(), biases.tail<3>()}, {});
    };
    const Preintegration center = run(at);
    const Eigen::MatrixXd numeric = test::NumericJacobian(
        [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return Difference(run(x), center); }, at,
        1e-5);
    EXPECT_LT((center.by_bias - numeric).norm(), 1e-8) << center.by_bias << "\n\n" << numeric;
  }
}

TEST(Preintegration, CovarianceIsThatOfMonteCarlo) {
  const SmoothMotion motion = WalkMotion();
  ProcessNoise noise;
  noise.gyro_density = 2e-3;
  noise.accel_density = 2e-2;
  std::mt19937_64 random(3);
  const Preintegration exact = Exact(motion, 0.1, 0.9, 100);
  constexpr int kRuns = 500;
  const auto clean = ReadImu(motion, 0.0, 1.0, 100, {}, random);
  double nees_sum = 0.0;
  Eigen::Matrix<double, 9, 9> seen = Eigen::Matrix<double, 9, 9>::Zero();
  Preintegration last;
  for (int i = 0; i < kRuns; ++i) {
    auto samples = clean;
    for (ImuSample& sample : samples) {
      sample.w_imu_radps += test::NormalVector(random, 10.0 * noise.gyro_density);  // at 100 Hz
      sample.f_imu_mps2 += test::NormalVector(random, 10.0 * noise.accel_density);
    }
    last = Preintegrate(samples, At(0.1), At(0.9), {}, noise);
    const Vector9 error = Difference(last, exact);
    nees_sum += error.dot(last.cov.ldlt().solve(error));
    seen += error * error.transpose() / kRuns;
  }
  // Linear interpolation makes neighbouring intervals share a sample: the noise of 80 samples is
  // then correlated, with sums that differ from white noise by half a sample at both ends.
  EXPECT_NEAR(nees_sum / (9 * kRuns), 1.0, 0.06);
  const Vector9 ratio = seen.diagonal().cwiseQuotient(last.cov.diagonal());
  EXPECT_LT((ratio - Vector9::Ones()).cwiseAbs().maxCoeff(), 0.2) << ratio.transpose();
}

TEST(Preintegration, HoldsTheReadingBeyondTheSamples) {
  ImuSample sample;
  sample.stamp = At(1.0);
  sample.w_imu_radps = {0, 0, 0.5};
  sample.f_imu_mps2 = {2.0, 0, 0};
  const Preintegration sum = Preintegrate({&sample, 1}, At(0.5), At(1.5), {}, {});
  EXPECT_NEAR(LogSo3(sum.rotation).z(), 0.5, 1e-12);
  // The value is |integral of 2 exp(0.5 i t)| over a second, in two steps.
  EXPECT_NEAR(sum.velocity.norm(), 2.0 * std::sin(0.25) / 0.25, 0.02);
}

TEST(Preintegration, RefusesNothingToIntegrate) {
  EXPECT_THROW(Preintegrate({}, At(0), At(1), {}, {}), std::invalid_argument);
  ImuSample sample;
  EXPECT_THROW(Preintegrate({&sample, 1}, At(1), At(0), {}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace lio
