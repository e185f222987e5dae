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

TEST(CarVibration, AStartRocksTheBodyForASecond) {
  const Trajectory trajectory = Parked(60.0);
  CarVibration car(trajectory, 1);
  const double start_s = kCarVibration.idles_s + kCarVibration.pauses_s;
  EXPECT_GT(RmsOf(car, start_s, start_s + 0.3, 0.0).f_imu_mps2.x(), 0.2);
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

TEST(CarVibration, WheelsShakeMostAtTheirHop) {
  const Trajectory trajectory = Parked(60.0);  // whose engine pauses from 25 to 40 s
  CarVibration car(trajectory, 1);
  const double slow = RmsOf(car, 30.0, 31.0, 5.0).f_imu_mps2.x();
  const double town = RmsOf(car, 31.0, 33.0, 10.0).f_imu_mps2.x();
  const double hop = RmsOf(car, 33.0, 35.0, 21.4).f_imu_mps2.x();
  EXPECT_LT(slow, 0.02);
  EXPECT_GT(town, 0.01);
  EXPECT_LT(town, 0.05);
  EXPECT_GT(hop, 0.1);
  EXPECT_LT(hop, 0.5);
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
