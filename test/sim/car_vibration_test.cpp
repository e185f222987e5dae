// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/car_vibration.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lio::sim {
namespace {

// Rests for 10 s, drives on at up to 10 m/s for 20 s and rests again.
Trajectory StopAndGo() {
  MotionPlan plan;
  plan.knot_interval_s = 0.25;
  double x_m = 0.0;
  for (int i = 0; i < 160; ++i) {
    const double t_s = 0.25 * i;
    BodyKnot knot;
    knot.position_m.x() = x_m;
    plan.knots.push_back(knot);
    if (t_s > 10.0 && t_s < 30.0) x_m += 0.25 * std::min(10.0, 2.0 * std::min(t_s - 10, 30 - t_s));
  }
  return Trajectory(plan);
}

Trajectory Parked(double duration_s) {
  MotionPlan plan;
  plan.knots.resize(static_cast<std::size_t>(duration_s / plan.knot_interval_s));
  return Trajectory(plan);
}

// Returns the root mean square of the acceleration's three axes together, and of the rate's.
CarVibration::Shake RmsOf(CarVibration& car, double begin_s, double end_s, double speed_mps) {
  CarVibration::Shake sum;
  int num = 0;
  for (double t_s = begin_s; t_s < end_s; t_s += 1e-3, ++num) {
    const CarVibration::Shake shake = car.At(t_s, speed_mps);
    sum.f_imu_mps2.x() += shake.f_imu_mps2.squaredNorm();
    sum.w_imu_radps.x() += shake.w_imu_radps.squaredNorm();
  }
  return {Vector3(std::sqrt(sum.f_imu_mps2.x() / num), 0, 0),
          Vector3(std::sqrt(sum.w_imu_radps.x() / num), 0, 0)};
}

TEST(CarVibration, TheEngineStopsAtRestAndStartsBeforeDrivingOff) {
  const Trajectory trajectory = StopAndGo();
  const CarVibration car(trajectory, 1);
  EXPECT_FALSE(car.EngineRunsAt(5.0));
  EXPECT_TRUE(car.EngineRunsAt(9.9));
  EXPECT_TRUE(car.EngineRunsAt(20.0));
  EXPECT_TRUE(car.EngineRunsAt(30.5));
  EXPECT_FALSE(car.EngineRunsAt(35.0));
}

TEST(CarVibration, AParkedCarIdlesWithPauses) {
  const Trajectory trajectory = Parked(60.0);
  CarVibration car(trajectory, 1);
  EXPECT_TRUE(car.EngineRunsAt(10.0));
  EXPECT_FALSE(car.EngineRunsAt(30.0));
  EXPECT_TRUE(car.EngineRunsAt(45.0));
  const CarVibration::Shake idle = RmsOf(car, 10.0, 12.0, 0.0);
  EXPECT_NEAR(idle.f_imu_mps2.x(), kCarVibration.idle_mps2 / std::sqrt(2.0), 1e-3);
  EXPECT_EQ(RmsOf(car, 35.0, 36.0, 0.0).f_imu_mps2.x(), 0.0);
}

// A tone of 0.5 m/s^2 that decays in 0.35 s is 0.245 m/s^2 rms over 0.3 s, and the engine idles
// with 0.08 beside it.
TEST(CarVibration, AStartRocksTheBodyForASecond) {
  const Trajectory trajectory = Parked(60.0);
  CarVibration car(trajectory, 1);
  const double start_s = kCarVibration.idles_s + kCarVibration.pauses_s;
  EXPECT_NEAR(RmsOf(car, start_s, start_s + 0.3, 0.0).f_imu_mps2.x(), 0.25, 0.025);
  EXPECT_GT(RmsOf(car, start_s + 0.3, start_s + 0.4, 0.0).w_imu_radps.x(), 1e-3);
  EXPECT_LT(RmsOf(car, start_s + 3.0, start_s + 4.0, 0.0).f_imu_mps2.x(), 0.1);
}

TEST(CarVibration, GearsKeepTheEngineWithinItsRange) {
  EXPECT_NEAR(FiringRate(0.0), 26.7, 0.01);
  for (double speed_mps = 4.0; speed_mps < 33.0; speed_mps += 0.5) {
    EXPECT_GE(FiringRate(speed_mps), 1400.0 / 30.0 - 0.1) << speed_mps;
    EXPECT_LE(FiringRate(speed_mps), 3200.0 / 30.0) << speed_mps;
  }
}

// Four wheels of 0.011 m/s^2 at 10 m/s, times 1.08 rms over wheels, grow with the square of the
// speed and with the resonance: by 1.05 at 5 m/s, 1.25 at 10, and its quality, 3, at 21.4. Their
// phases are drawn once a car, which leaves 7 % to the root mean square over 400 cars.
TEST(CarVibration, WheelsShakeMostAtTheirHop) {
  const Trajectory trajectory = Parked(60.0);  // whose engine pauses from 25 to 40 s
  double slow_sq = 0.0, town_sq = 0.0, hop_sq = 0.0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    CarVibration car(trajectory, seed);
    const auto square = [&](double begin_s, double speed_mps) {
      const double rms = RmsOf(car, begin_s, begin_s + 0.8, speed_mps).f_imu_mps2.x();
      return rms * rms / 400.0;
    };
    slow_sq += square(30.0, 5.0);
    town_sq += square(31.0, 10.0);
    hop_sq += square(33.0, 21.4);
  }
  const double unit = 2.0 * 1.08 * 0.011 / std::sqrt(2.0);
  EXPECT_NEAR(std::sqrt(slow_sq), 0.25 * 1.05 * unit, 0.07 * 0.25 * 1.05 * unit);
  EXPECT_NEAR(std::sqrt(town_sq), 1.25 * unit, 0.07 * 1.25 * unit);
  EXPECT_NEAR(std::sqrt(hop_sq), 4.58 * 3.0 * unit, 0.07 * 4.58 * 3.0 * unit);
}

TEST(CarVibration, TheSameSeedShakesAlike) {
  const Trajectory trajectory = StopAndGo();
  CarVibration one(trajectory, 7);
  CarVibration same(trajectory, 7);
  CarVibration other(trajectory, 8);
  for (double t_s = 15.0; t_s < 15.1; t_s += 0.01) {
    const CarVibration::Shake shake = one.At(t_s, 10.0);
    EXPECT_EQ(shake.f_imu_mps2, same.At(t_s, 10.0).f_imu_mps2);
    EXPECT_NE(shake.f_imu_mps2, other.At(t_s, 10.0).f_imu_mps2);
  }
}

}  // namespace
}  // namespace lio::sim
