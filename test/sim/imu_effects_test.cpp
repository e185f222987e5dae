// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Each effect of a vehicle on an IMU is measured by switching it on alone.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lio/sim/imu_simulator.hpp"
#include "lio/sim/scenario.hpp"

namespace lio::sim {
namespace {

constexpr double kRoundGravity_mps2 = 9.8;

// Only what the effects ask of the model: no other error.
ImuModel ModelOf(const std::string& name) {
  ImuModel model = LoadImuModel(name);
  for (InertialModel* triad : {&model.gyro, &model.accel}) {
    triad->noise_density = triad->bias_walk_density = triad->bias_instability = 0.0;
    triad->turn_on_bias_std = triad->scale_std_ratio = triad->misalignment_std_rad = 0.0;
    triad->full_scale = triad->step = 0.0;
  }
  return model;
}

struct Errors {
  double speed_mps = 0.0;
  Vector3 gyro_radps;
  Vector3 accel_mps2;
};

std::vector<Errors> ErrorsOn(const Trajectory& trajectory, double begin_s, const ImuSetup& setup,
                             double seconds) {
  ImuSimulator imu(setup, trajectory);
  std::vector<Errors> errors;
  const double period_s = 1.0 / setup.model.rate_hz;
  for (int i = 0; i < static_cast<int>(seconds / period_s); ++i) {
    const SimulatedImu at = imu.Sample(std::llround(1e9 * (begin_s + period_s * i)));
    const Vector3 f = at.truth.T_world_imu.rotation.conjugate() *
                      (at.truth.a_world_mps2 + Vector3(0, 0, kRoundGravity_mps2));
    errors.push_back({at.truth.v_world_mps.norm(), at.sample.w_imu_radps - at.truth.w_imu_radps,
                      at.sample.f_imu_mps2 - f});
  }
  return errors;
}

std::vector<Errors> ErrorsInTheStreet(const std::string& model, const ImuEffects& effects) {
  const Scenario street = MakeScenario("street", {1, 20.0, true});
  const ImuSetup setup{ModelOf(model), ImuVariant::kNormal, kRoundGravity_mps2, effects, 1};
  return ErrorsOn(*street.trajectory, street.begin_s, setup, 15.0);
}

// Returns the spread over 100 units of an error at the end of some time at rest, level.
Errors SpreadAtRest(const std::string& model, const ImuEffects& effects, double seconds) {
  MotionPlan plan;
  plan.knots.resize(4);
  const Trajectory still(plan);
  Errors spread{0.0, Vector3::Zero(), Vector3::Zero()};
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    ImuSetup setup{ModelOf(model), ImuVariant::kNormal, kRoundGravity_mps2, effects, seed};
    setup.model.rate_hz = 1.0;
    const Errors last = ErrorsOn(still, 0.0, setup, seconds).back();
    spread.gyro_radps += last.gyro_radps.cwiseAbs2() / 100.0;
    spread.accel_mps2 += last.accel_mps2.cwiseAbs2() / 100.0;
  }
  return {0.0, spread.gyro_radps.cwiseSqrt(), spread.accel_mps2.cwiseSqrt()};
}

TEST(ImuEffects, WithoutThemNothingIsAdded) {
  for (const Errors& error : ErrorsInTheStreet("consumer_mems", {})) {
    ASSERT_LT(error.accel_mps2.norm(), 1e-9);
    ASSERT_LT(error.gyro_radps.norm(), 1e-9);
  }
}

TEST(ImuEffects, VibrationIsWhiteAndGrowsWithSpeed) {
  ImuEffects effects;
  effects.vibrates = true;
  double accel_sq = 0.0;
  double gyro_sq = 0.0;
  double speed_sq = 0.0;
  for (const Errors& error : ErrorsInTheStreet("xsens_mti10", effects)) {
    accel_sq += error.accel_mps2.squaredNorm() / 3.0;
    gyro_sq += error.gyro_radps.squaredNorm() / 3.0;
    speed_sq += error.speed_mps * error.speed_mps;
  }
  EXPECT_NEAR(std::sqrt(accel_sq / speed_sq), 0.012, 6e-4);
  EXPECT_NEAR(std::sqrt(gyro_sq / speed_sq), 2e-4, 1e-5);
}

TEST(ImuEffects, EngineAndWheelsShakeADrivingCar) {
  ImuEffects effects;
  effects.has_engine = true;
  double sum_sq = 0.0;
  double gyro_sq = 0.0;
  int num = 0;
  for (const Errors& error : ErrorsInTheStreet("xsens_mti10", effects)) {
    if (error.speed_mps < 5.0) continue;
    sum_sq += error.accel_mps2.squaredNorm();
    gyro_sq += error.gyro_radps.squaredNorm();
    ++num;
  }
  ASSERT_GT(num, 500);
  // The engine adds a tone of 0.05 + 0.005 * 10 m/s^2, and the wheels 0.02.
  EXPECT_GT(std::sqrt(sum_sq / num), 0.05);
  EXPECT_LT(std::sqrt(sum_sq / num), 0.12);
  EXPECT_GT(std::sqrt(gyro_sq / num), 5e-5);
  EXPECT_LT(std::sqrt(gyro_sq / num), 1e-3);
}

TEST(ImuEffects, VibrationIsRectifiedIntoTheBias) {
  ImuEffects effects;
  effects.rectifies = true;
  double largest = 0.0;
  for (const Errors& error : ErrorsInTheStreet("consumer_mems", effects)) {
    const double element_mps2 = kElementVibrationRatio * 0.03 * error.speed_mps;
    const double size = error.accel_mps2.norm() / (element_mps2 * element_mps2 + 1e-6);
    EXPECT_LT(size, 3.0 * std::sqrt(3.0) * 3e-4);
    largest = std::max(largest, error.accel_mps2.norm());
  }
  EXPECT_GT(largest, 1e-4);
}

TEST(ImuEffects, GyrosFeelGravity) {
  ImuEffects effects;
  effects.is_g_sensitive = true;
  const Errors spread = SpreadAtRest("consumer_mems", effects, 2.0);
  const double expected = 0.05 * std::numbers::pi / 180.0;  // rad/s at 1 g
  for (const double axis : spread.gyro_radps) EXPECT_NEAR(axis, expected, 0.25 * expected);
  EXPECT_EQ(spread.accel_mps2.norm(), 0.0);
}

TEST(ImuEffects, BiasesDriftWhileTheUnitWarmsUp) {
  ImuEffects effects;
  effects.warms_up = true;
  const Errors spread = SpreadAtRest("consumer_mems", effects, 201.0);
  const double kelvin = 10.0 * (1.0 - std::exp(-1.0));
  for (const double axis : spread.gyro_radps) EXPECT_NEAR(axis, 2.6e-4 * kelvin, 5e-4);
  for (const double axis : spread.accel_mps2) EXPECT_NEAR(axis, 2e-3 * kelvin, 4e-3);
  EXPECT_EQ(SpreadAtRest("consumer_mems", effects, 1.0).gyro_radps.norm(), 0.0);
}

}  // namespace
}  // namespace lio::sim
