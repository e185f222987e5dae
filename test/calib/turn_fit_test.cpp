// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "calib/turn_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "calib/sensor_pair.hpp"
#include "support/random_state.hpp"

namespace lio {
namespace {

using test::kExtrinsic;
using test::kOffset_s;
using test::LookAbout;
using test::Stand;

std::vector<ImuSample> Samples() {
  return test::BiasedSamples(LookAbout, 20.0);
}

// Returns neighbouring turns between sweeps that each err by `sweep_std_rad`, with `turn_std_rad`
// in addition.
std::vector<SweepTurn> NeighbouringTurns(const test::Motion& motion, double sweep_std_rad = 0.0,
                                         double turn_std_rad = 0.0) {
  std::mt19937_64 random(5);
  std::vector<Quaternion> sweeps;
  for (int i = 0; i <= 180; ++i) {
    sweeps.push_back(motion(1.0 + 0.1 * i + kOffset_s).rotation * kExtrinsic *
                     ExpSo3(sweep_std_rad * test::RandomVector<3>(random)));
  }
  std::vector<SweepTurn> turns;
  for (std::size_t i = 0; i < 180; ++i) {
    const double from_s = 1.0 + 0.1 * static_cast<double>(i);
    turns.push_back({i, test::StampAt(from_s), test::StampAt(from_s + 0.1),
                     sweeps[i].conjugate() * sweeps[i + 1] *
                         ExpSo3(turn_std_rad * test::RandomVector<3>(random))});
  }
  return turns;
}

// This is the error that the preceding search leaves.
RotationCalibration Guess() {
  RotationCalibration guess;
  guess.offset_s = kOffset_s + 0.01;
  guess.R_imu_lidar = kExtrinsic * ExpSo3(Vector3(0.03, -0.02, 0.04));
  return guess;
}

double RotationError(const RotationCalibration& state) {
  return LogSo3(state.R_imu_lidar.conjugate() * kExtrinsic).norm();
}

TEST(TurnFit, ExactTurnsGiveTheTruth) {
  RotationCalibration state = Guess();
  const auto turns = NeighbouringTurns(LookAbout);
  ASSERT_TRUE(FitTurns(Samples(), turns, state));
  EXPECT_EQ(state.num_turns, 180);
  EXPECT_NEAR(state.offset_s, kOffset_s, 2e-5);
  EXPECT_LT(RotationError(state), 2e-4);
  EXPECT_LT((state.gyro_bias_radps - test::kGyroBias).norm(), 1e-5);
  EXPECT_NEAR(state.R_imu_lidar.norm(), 1.0, 1e-12);
}

// A sweep's own error appears twice, with opposite signs; a turn's additional error does not.
TEST(TurnFit, SweepsOwnErrorsAndTurnsAreToldApart) {
  constexpr double kLarge_rad = 2e-3;
  RotationCalibration of_sweeps = Guess();
  ASSERT_TRUE(FitTurns(Samples(), NeighbouringTurns(LookAbout, kLarge_rad, 0.0), of_sweeps));
  EXPECT_NEAR(of_sweeps.sweep_std_rad, kLarge_rad, 0.2 * kLarge_rad);
  EXPECT_LT(of_sweeps.turn_std_rad, 0.5 * kLarge_rad);
  RotationCalibration of_turns = Guess();
  ASSERT_TRUE(FitTurns(Samples(), NeighbouringTurns(LookAbout, 0.0, kLarge_rad), of_turns));
  EXPECT_NEAR(of_turns.turn_std_rad, kLarge_rad, 0.2 * kLarge_rad);
  EXPECT_LT(of_turns.sweep_std_rad, 0.5 * kLarge_rad);
}

TEST(TurnFit, NoiseIsInTheCovarianceAndTheResidualRatioIsOne) {
  RotationCalibration quiet = Guess(), noisy = Guess();
  ASSERT_TRUE(FitTurns(Samples(), NeighbouringTurns(LookAbout, 0.0, 5e-4), quiet));
  ASSERT_TRUE(FitTurns(Samples(), NeighbouringTurns(LookAbout, 0.0, 5e-3), noisy));
  for (const RotationCalibration* state : {&quiet, &noisy}) {
    EXPECT_NEAR(state->residual_ratio, 1.0, 0.25);
    EXPECT_LT(std::abs(state->offset_s - kOffset_s), 4 * state->offset_std_s);
    EXPECT_LT(RotationError(*state), 4 * std::sqrt(state->rotation_cov.trace()));
  }
  EXPECT_NEAR(noisy.offset_std_s / quiet.offset_std_s, 10.0, 2.5);
  EXPECT_NEAR(std::sqrt(noisy.rotation_cov.trace() / quiet.rotation_cov.trace()), 10.0, 2.5);
}

TEST(TurnFit, AFewWildTurnsDoLittleHarm) {
  auto turns = NeighbouringTurns(LookAbout, 0.0, 5e-4);
  for (std::size_t i = 10; i < turns.size(); i += 40) {
    turns[i].R_from_to = turns[i].R_from_to * ExpSo3(Vector3(0.3, 0.2, -0.4));
  }
  RotationCalibration state = Guess();
  ASSERT_TRUE(FitTurns(Samples(), turns, state));
  EXPECT_NEAR(state.offset_s, kOffset_s, 2e-3);
  EXPECT_LT(RotationError(state), 3e-3);
  EXPECT_LT(state.turn_std_rad, 1e-3);
}

TEST(TurnFit, MissingTurnsAreNoNeighbours) {
  auto turns = NeighbouringTurns(LookAbout, 2e-3, 0.0);
  std::erase_if(turns, [](const SweepTurn& turn) { return turn.first % 7 == 3; });
  RotationCalibration state = Guess();
  ASSERT_TRUE(FitTurns(Samples(), turns, state));
  EXPECT_EQ(state.num_turns, static_cast<int>(turns.size()));
  EXPECT_NEAR(state.sweep_std_rad, 2e-3, 5e-4);
}

TEST(TurnFit, RestDoesNotDetermineIt) {
  RotationCalibration state = Guess();
  EXPECT_FALSE(
      FitTurns(test::BiasedSamples(Stand, 20.0), NeighbouringTurns(Stand, 0.0, 1e-4), state));
}

}  // namespace
}  // namespace lio
