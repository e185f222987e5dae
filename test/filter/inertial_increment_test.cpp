// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "filter/inertial_increment.hpp"

#include <gtest/gtest.h>

#include "lio/base/pose.hpp"
#include "support/numeric_jacobian.hpp"

namespace lio {
namespace {

ImuSample SampleAt(double t_s, const Vector3& rate, const Vector3& force) {
  ImuSample sample;
  sample.stamp = Timestamp{} + Duration::FromSeconds(t_s);
  sample.w_imu_radps = rate;
  sample.f_imu_mps2 = force;
  return sample;
}

const Vector3 kZero = Vector3::Zero();

// The two samples have all components and biases.
struct Case {
  ImuSample from = SampleAt(0.0, {0.7, -1.1, 2.0}, {3.0, -1.0, 9.0});
  ImuSample to = SampleAt(0.05, {1.5, 0.4, 1.2}, {2.0, 2.5, 11.0});
  Vector3 gyro_bias{0.02, -0.03, 0.05};
  Vector3 accel_bias{0.1, 0.3, -0.2};
};

TEST(InertialIncrement, NoTimeChangesNothing) {
  const ImuSample sample = SampleAt(3.0, {1, 2, 3}, {4, 5, 6});
  const InertialIncrement increment = MakeIncrement(sample, sample, kZero, kZero);
  EXPECT_EQ(increment.dt_s, 0.0);
  EXPECT_EQ(increment.turn.coeffs(), Quaternion::Identity().coeffs());
  EXPECT_EQ(increment.velocity, kZero);
  EXPECT_EQ(increment.position, kZero);
}

TEST(InertialIncrement, ConstantForceWithoutTurningIsTheSchoolFormula) {
  const Vector3 force(2.0, -4.0, 10.0);
  const InertialIncrement increment =
      MakeIncrement(SampleAt(1.0, kZero, force), SampleAt(1.5, kZero, force), kZero, kZero);
  EXPECT_EQ(increment.dt_s, 0.5);
  EXPECT_LT((increment.velocity - Vector3(1.0, -2.0, 5.0)).norm(), 1e-12);
  EXPECT_LT((increment.position - Vector3(0.25, -0.5, 1.25)).norm(), 1e-12);
}

// The force rises from 0 to f: its integrals are f t/2 and f t^2/6.
TEST(InertialIncrement, ForceRunsLinearlyBetweenTheSamples) {
  const InertialIncrement increment =
      MakeIncrement(SampleAt(0.0, kZero, kZero), SampleAt(0.2, kZero, {6, 0, 0}), kZero, kZero);
  EXPECT_NEAR(increment.velocity.x(), 0.6, 1e-12);
  EXPECT_NEAR(increment.position.x(), 0.04, 1e-12);
}

TEST(InertialIncrement, MeanRateAboutOneAxisTurns) {
  const InertialIncrement increment =
      MakeIncrement(SampleAt(0.0, {0, 0, 1}, kZero), SampleAt(0.1, {0, 0, 3}, kZero), kZero, kZero);
  EXPECT_LT((LogSo3(increment.turn) - Vector3(0, 0, 0.2)).norm(), 1e-12);
}

// The coning term dt^2/12 (x cross y) is dt^2/12 about z, which the mean rate alone does not have.
TEST(InertialIncrement, RatesThatChangeTheirAxisCone) {
  const InertialIncrement increment = MakeIncrement(SampleAt(0.0, {1, 0, 0}, kZero),
                                                    SampleAt(0.12, {0, 1, 0}, kZero), kZero, kZero);
  EXPECT_LT((LogSo3(increment.turn) - Vector3(0.06, 0.06, 0.0012)).norm(), 1e-12);
}

TEST(InertialIncrement, ForceAtTheEndIsSeenFromTheBeginning) {
  // After a quarter turn about z, x at the end is y at the beginning.
  const ImuSample from = SampleAt(0.0, {0, 0, M_PI / 2}, kZero);
  const ImuSample to = SampleAt(1.0, {0, 0, M_PI / 2}, {3, 0, 0});
  const InertialIncrement increment = MakeIncrement(from, to, kZero, kZero);
  EXPECT_LT((increment.velocity - Vector3(0, 1.5, 0)).norm(), 1e-12);
  EXPECT_LT((increment.position - Vector3(0, 0.5, 0)).norm(), 1e-12);
}

TEST(InertialIncrement, BiasesAreTakenOutOfBothSamples) {
  const Case c;
  const auto clean = [&](ImuSample sample) {
    sample.w_imu_radps -= c.gyro_bias;
    sample.f_imu_mps2 -= c.accel_bias;
    return sample;
  };
  const InertialIncrement biased = MakeIncrement(c.from, c.to, c.gyro_bias, c.accel_bias);
  const InertialIncrement free = MakeIncrement(clean(c.from), clean(c.to), kZero, kZero);
  EXPECT_LT((biased.turn.coeffs() - free.turn.coeffs()).norm(), 1e-15);
  EXPECT_LT((biased.velocity - free.velocity).norm(), 1e-15);
  EXPECT_LT((biased.position - free.position).norm(), 1e-15);
}

// Integrates rates and forces that are linear in time, in n steps.
InertialIncrement Integrate(const Case& c, int num_steps) {
  const auto sample_at = [&](int i) {
    const double share = static_cast<double>(i) / num_steps;
    return SampleAt(0.05 * share,
                    c.from.w_imu_radps + share * (c.to.w_imu_radps - c.from.w_imu_radps),
                    c.from.f_imu_mps2 + share * (c.to.f_imu_mps2 - c.from.f_imu_mps2));
  };
  InertialIncrement sum;
  for (int i = 0; i < num_steps; ++i) {
    const InertialIncrement step =
        MakeIncrement(sample_at(i), sample_at(i + 1), c.gyro_bias, c.accel_bias);
    sum.position += step.dt_s * sum.velocity + sum.turn * step.position;
    sum.velocity += sum.turn * step.velocity;
    sum.turn = sum.turn * step.turn;
    sum.dt_s += step.dt_s;
  }
  return sum;
}

TEST(InertialIncrement, HalvingTheStepQuartersTheError) {
  const Case c;
  const InertialIncrement truth = Integrate(c, 1000);
  const auto error = [&](int num_steps) {
    const InertialIncrement sum = Integrate(c, num_steps);
    return (Eigen::Matrix<double, 6, 1>() << sum.velocity - truth.velocity,
            sum.position - truth.position)
        .finished()
        .norm();
  };
  EXPECT_GT(error(1), 1e-6);
  EXPECT_NEAR(error(1) / error(2), 4.0, 0.3);
  EXPECT_NEAR(error(2) / error(4), 4.0, 0.3);
}

TEST(InertialIncrement, DerivativesAgreeWithDifferences) {
  const Case c;
  IncrementByBias by_bias;
  const InertialIncrement at = MakeIncrement(c.from, c.to, c.gyro_bias, c.accel_bias, by_bias);
  const auto changed = [&](const Eigen::VectorXd& biases) -> Eigen::VectorXd {
    const InertialIncrement moved = MakeIncrement(c.from, c.to, biases.head<3>(), biases.tail<3>());
    Eigen::VectorXd change(9);
    change << LogSo3(at.turn.conjugate() * moved.turn), moved.velocity, moved.position;
    return change;
  };
  const Vector6 biases = (Vector6() << c.gyro_bias, c.accel_bias).finished();
  const Eigen::MatrixXd numeric = test::NumericJacobian(changed, biases);
  Eigen::Matrix<double, 9, 6> analytic;
  analytic << by_bias.turn_by_gyro, Matrix3::Zero(), by_bias.velocity_by_gyro,
      by_bias.velocity_by_accel, by_bias.position_by_gyro, by_bias.position_by_accel;
  EXPECT_LT((analytic - numeric).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(InertialIncrement, AskingForDerivativesChangesNothing) {
  const Case c;
  IncrementByBias by_bias;
  const InertialIncrement with = MakeIncrement(c.from, c.to, c.gyro_bias, c.accel_bias, by_bias);
  const InertialIncrement without = MakeIncrement(c.from, c.to, c.gyro_bias, c.accel_bias);
  EXPECT_EQ(with.turn.coeffs(), without.turn.coeffs());
  EXPECT_LT((with.velocity - without.velocity).norm(), 1e-15);
  EXPECT_LT((with.position - without.position).norm(), 1e-15);
}

}  // namespace
}  // namespace lio
