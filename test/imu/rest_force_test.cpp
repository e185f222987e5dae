// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/imu/rest_force.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "support/motion.hpp"
#include "support/numeric_jacobian.hpp"
#include "support/random_state.hpp"

namespace lio {
namespace {

using test::Motion;
using test::StampAt;

constexpr double kStep_s = 0.005;
constexpr int kNumSamples = 201;  // a second

std::vector<ImuSample> SamplesAlong(const Motion& motion) {
  std::vector<ImuSample> samples;
  samples.reserve(kNumSamples);
  for (int i = 0; i < kNumSamples; ++i) {
    samples.push_back(test::ExactSample(motion, kStep_s * i));
  }
  return samples;
}

// Rolls and nods in place by some degrees, as in a hand.
Motion Swaying() {
  return [](double t_s) {
    return Pose{ExpSo3(Vector3(0.06 * std::sin(2.0 * t_s), 0, 0)) *
                    ExpSo3(Vector3(0, 0.04 * std::cos(3.0 * t_s), 0)),
                Vector3::Zero()};
  };
}

// Goes to and fro along x once in a second.
constexpr double kShake_radps = 2.0 * M_PI;
constexpr double kShake_m = 0.02;
Motion ToAndFro() {
  return [](double t_s) {
    return Pose{Quaternion::Identity(), Vector3(kShake_m * std::sin(kShake_radps * t_s), 0, 0)};
  };
}

TEST(RestForce, IsThatOfTheInstantAskedForHoweverTheBodySways) {
  const std::vector<ImuSample> samples = SamplesAlong(Swaying());
  for (const double at_s : {0.0, 0.4, 0.9, 1.0}) {
    const RestForce rest = MeanForceAtRest(samples, StampAt(at_s), Vector3::Zero());
    const Vector3 up = Swaying()(at_s).rotation.conjugate() * Vector3::UnitZ();
    EXPECT_LT((rest.mean_mps2.normalized() - up).norm(), 1e-4) << at_s;
  }
  Vector3 unturned = Vector3::Zero();
  for (const ImuSample& sample : samples) unturned += sample.f_imu_mps2 / kNumSamples;
  const Vector3 up_at_end = Swaying()(1.0).rotation.conjugate() * Vector3::UnitZ();
  EXPECT_GT((unturned.normalized() - up_at_end).norm(), 0.02) << "a mean of old directions";
}

TEST(RestForce, DerivativeByTheGyrosBiasIsTheNumericOne) {
  const std::vector<ImuSample> samples = SamplesAlong(Swaying());
  const Vector3 bias(0.01, -0.02, 0.03);
  for (const double at_s : {0.0, 0.4, 1.0}) {
    const auto mean = [&](const Eigen::VectorXd& gyro_bias) {
      return MeanForceAtRest(samples, StampAt(at_s), gyro_bias).mean_mps2;
    };
    const Eigen::MatrixXd numeric = test::NumericJacobian(mean, bias, 1e-5);
    const Matrix3 analytic = MeanForceAtRest(samples, StampAt(at_s), bias).by_gyro_bias;
    EXPECT_LT((numeric - analytic).cwiseAbs().maxCoeff(), 2e-3 * numeric.cwiseAbs().maxCoeff())
        << at_s;
  }
}

TEST(RestForce, ScatterOfPartsIsTheVarianceOfAMeanOfWhiteNoise) {
  constexpr int kRuns = 400;
  constexpr double kStd_mps2 = 0.1;
  std::mt19937_64 random(5);
  double mean_var = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<ImuSample> samples = SamplesAlong([](double) { return Pose{}; });
    for (ImuSample& sample : samples) {
      sample.f_imu_mps2 += kStd_mps2 * test::RandomVector<3>(random);
    }
    mean_var += MeanForceAtRest(samples, StampAt(1.0), Vector3::Zero()).scatter_var / kRuns;
  }
  // Nine degrees of freedom a run: 2.4 % over all.
  EXPECT_NEAR(mean_var / (kStd_mps2 * kStd_mps2 / kNumSamples), 1.0, 0.1);
}

TEST(RestForce, ScatterOfPartsSeesThatASwayLasts) {
  const std::vector<ImuSample> samples = SamplesAlong(ToAndFro());
  const double amplitude_mps2 = kShake_m * kShake_radps * kShake_radps;
  const double as_if_white = 0.5 * amplitude_mps2 * amplitude_mps2 / kNumSamples;
  EXPECT_GT(MeanForceAtRest(samples, StampAt(1.0), Vector3::Zero()).scatter_var, 5.0 * as_if_white);
}

TEST(RestForce, TellsHowFastTheBodyMovesAgainstItsMean) {
  const RestForce rest = MeanForceAtRest(SamplesAlong(ToAndFro()), StampAt(1.0), Vector3::Zero());
  EXPECT_NEAR(rest.velocity_mps.x(), kShake_m * kShake_radps, 1e-3);
  EXPECT_NEAR(rest.velocity_mps.tail<2>().norm(), 0.0, 1e-6);
  EXPECT_NEAR(
      MeanForceAtRest(SamplesAlong(Swaying()), StampAt(1.0), Vector3::Zero()).velocity_mps.norm(),
      0.0, 1e-3);
}

TEST(RestForce, SpreadIsOfWhatPushesNotOfWhatTurns) {
  EXPECT_LT(SpreadOfTurnedForce(SamplesAlong(Swaying())), 1e-3);
  EXPECT_NEAR(SpreadOfTurnedForce(SamplesAlong(ToAndFro())),
              kShake_m * kShake_radps * kShake_radps / std::sqrt(2.0), 0.01);
  EXPECT_EQ(SpreadOfTurnedForce({}), 0.0);
}

TEST(RestForce, ATurnToAndFroIsToldFromASteadyOne) {
  const Motion turning = [](double t_s) {
    return Pose{ExpSo3(Vector3(0, 0, 0.3 * t_s)), Vector3::Zero()};
  };
  EXPECT_NEAR(TurnToAndFro(SamplesAlong(turning)), 0.0, 2e-3);
  const Motion nodding = [](double t_s) {
    return Pose{ExpSo3(Vector3(0, 0.03 * std::sin(kShake_radps * t_s), 0)), Vector3::Zero()};
  };
  EXPECT_NEAR(TurnToAndFro(SamplesAlong(nodding)), 0.03, 2e-3);
}

TEST(RestForce, OfABodyThatDoesNotTurnTheGyroTellsNothing) {
  const std::vector<ImuSample> samples = SamplesAlong(Swaying());
  const RestForce rest = MeanForceUnturned(samples, StampAt(1.0));
  Vector3 mean = Vector3::Zero();
  for (const ImuSample& sample : samples) mean += sample.f_imu_mps2 / kNumSamples;
  EXPECT_LT((rest.mean_mps2 - mean).norm(), 1e-2);
  EXPECT_EQ(rest.by_gyro_bias, Matrix3::Zero());
}

TEST(RestForce, OneSampleIsItsOwnMean) {
  const std::vector<ImuSample> samples = {test::ExactSample(Swaying(), 0.3)};
  const RestForce rest = MeanForceAtRest(samples, StampAt(1.0), Vector3::Zero());
  EXPECT_EQ(rest.mean_mps2, samples.front().f_imu_mps2);
  EXPECT_THROW((void)MeanForceAtRest({}, StampAt(1.0), Vector3::Zero()), std::invalid_argument);
}

}  // namespace
}  // namespace lio
