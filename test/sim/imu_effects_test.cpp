// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Each effect of a vehicle on an IMU is measured by switching it on alone.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

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

// Goes straight ahead, level.
Trajectory AtSpeed(double speed_mps) {
  MotionPlan plan;
  for (int i = 0; i < 200; ++i) {
    plan.knots.emplace_back().position_m.x() = speed_mps * plan.knot_interval_s * i;
  }
  return Trajectory(plan);
}

struct Rms {
  double gyro_radps = 0.0;
  double accel_mps2 = 0.0;
};

// Returns the root mean square over the axes of 100 units of an error after some time. It is that
// of 300 draws, so three of its standard errors are 12 %.
constexpr double kBoundRatio = 0.12;
Rms RmsOfUnits(const std::string& model, const ImuEffects& effects, double speed_mps,
               double seconds) {
  const Trajectory trajectory = AtSpeed(speed_mps);
  Rms rms;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    ImuSetup setup{ModelOf(model), ImuVariant::kNormal, kRoundGravity_mps2, effects, seed};
    setup.model.rate_hz = 1.0;
    const Errors last = ErrorsOn(trajectory, 0.0, setup, seconds).back();
    rms.gyro_radps += last.gyro_radps.squaredNorm() / 300.0;
    rms.accel_mps2 += last.accel_mps2.squaredNorm() / 300.0;
  }
  return {std::sqrt(rms.gyro_radps), std::sqrt(rms.accel_mps2)};
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

// At 10 m/s the engine's tone of 0.1 m/s^2 has 61 Hz, and each wheel's, 5.1 Hz, is 1.25 times the
// pull of its unbalance, 1.08 times 0.011 m/s^2 rms over wheels. A tone's rate is its acceleration
// over 1.5 m and its angular frequency. Phases of the four wheels are drawn once a car, which
// leaves 14 % to the root mean square over 100 cars.
TEST(ImuEffects, EngineAndWheelsShakeADrivingCar) {
  ImuEffects effects;
  effects.has_engine = true;
  const Trajectory road = AtSpeed(10.0);
  double accel_sq = 0.0;
  double gyro_sq = 0.0;
  int num = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const ImuSetup setup{ModelOf("xsens_mti10"), ImuVariant::kNormal, kRoundGravity_mps2, effects,
                         seed};
    for (const Errors& error : ErrorsOn(road, 3.0, setup, 1.0)) {
      accel_sq += error.accel_mps2.squaredNorm();
      gyro_sq += error.gyro_radps.squaredNorm();
      ++num;
    }
  }
  const double engine_mps2 = 0.1 / std::sqrt(2.0);
  const double wheels_mps2 = 2.0 * 1.08 * 0.011 * 1.25 / std::sqrt(2.0);
  const double to_engine_rate = 1.0 / (2.0 * std::numbers::pi * 60.6 * 1.5);
  const double to_wheel_rate = 1.0 / (2.0 * std::numbers::pi * 5.13 * 1.5);
  const double accel = std::hypot(engine_mps2, wheels_mps2);
  const double gyro = std::hypot(engine_mps2 * to_engine_rate, wheels_mps2 * to_wheel_rate);
  EXPECT_NEAR(std::sqrt(accel_sq / num), accel, 0.03 * accel);
  EXPECT_NEAR(std::sqrt(gyro_sq / num), gyro, 0.14 * gyro);
}

struct Unit {
  const char* model;
  double vibration_mps2_per_mps;
  double mg_per_g_sq;
  double degps_per_g_sq;
  double degps_per_g;
};
constexpr std::array<Unit, 2> kUnits = {Unit{"xsens_mti10", 0.012, 1.0, 0.002, 0.006},
                                        Unit{"consumer_mems", 0.03, 3.0, 0.01, 0.05}};
constexpr double kG_mps2 = 9.80665;
constexpr double kDegree_rad = std::numbers::pi / 180.0;

// The sensing elements feel five times the vibration that is left in the samples.
TEST(ImuEffects, VibrationIsRectifiedIntoTheBias) {
  ImuEffects effects;
  effects.rectifies = true;
  for (const Unit& unit : kUnits) {
    const double in_g = 5.0 * unit.vibration_mps2_per_mps * 10.0 / kG_mps2;
    const double accel = 1e-3 * kG_mps2 * unit.mg_per_g_sq * in_g * in_g;
    const double gyro = kDegree_rad * unit.degps_per_g_sq * in_g * in_g;
    const Rms rms = RmsOfUnits(unit.model, effects, 10.0, 3.0);
    EXPECT_NEAR(rms.accel_mps2, accel, kBoundRatio * accel) << unit.model;
    EXPECT_NEAR(rms.gyro_radps, gyro, kBoundRatio * gyro) << unit.model;
    EXPECT_EQ(RmsOfUnits(unit.model, effects, 0.0, 3.0).accel_mps2, 0.0) << "at rest";
  }
}

TEST(ImuEffects, RectificationGrowsWithTheSquareOfTheSpeed) {
  ImuEffects effects;
  effects.rectifies = true;
  std::optional<double> per_speed_sq;
  int num = 0;
  for (const Errors& error : ErrorsInTheStreet("consumer_mems", effects)) {
    if (error.speed_mps < 1.0) continue;
    const double ratio = error.accel_mps2.norm() / (error.speed_mps * error.speed_mps);
    if (!per_speed_sq) per_speed_sq = ratio;
    EXPECT_NEAR(ratio, *per_speed_sq, 1e-6 * *per_speed_sq);
    ++num;
  }
  EXPECT_GT(num, 1000);
}

TEST(ImuEffects, GyrosFeelGravity) {
  ImuEffects effects;
  effects.is_g_sensitive = true;
  for (const Unit& unit : kUnits) {
    const Rms rms = RmsOfUnits(unit.model, effects, 0.0, 2.0);
    const double expected = unit.degps_per_g * kDegree_rad;
    EXPECT_NEAR(rms.gyro_radps, expected, kBoundRatio * expected) << unit.model;
    EXPECT_EQ(rms.accel_mps2, 0.0);
  }
}

TEST(ImuEffects, BiasesDriftWhileTheUnitWarmsUp) {
  ImuEffects effects;
  effects.warms_up = true;
  const Rms rms = RmsOfUnits("consumer_mems", effects, 0.0, 201.0);
  const double kelvin = 10.0 * (1.0 - std::exp(-1.0));
  const double gyro = 0.015 * kDegree_rad * kelvin;
  const double accel = 0.2e-3 * kG_mps2 * kelvin;
  EXPECT_NEAR(rms.gyro_radps, gyro, kBoundRatio * gyro);
  EXPECT_NEAR(rms.accel_mps2, accel, kBoundRatio * accel);
  EXPECT_EQ(RmsOfUnits("consumer_mems", effects, 0.0, 1.0).gyro_radps, 0.0);
}

}  // namespace
}  // namespace lio::sim
