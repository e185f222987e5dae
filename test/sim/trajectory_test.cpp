// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/trajectory.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "lio/sim/random.hpp"
#include "sim/drive.hpp"

namespace lio::sim {
namespace {

MotionPlan LivelyPlan() {
  MotionPlan plan;
  plan.knot_interval_s = 0.2;
  Random random(7, Purpose::kMotion);
  for (int i = 0; i < 40; ++i) {
    BodyKnot knot;
    knot.position_m = {0.5 * i + random.Gaussian(), random.Gaussian(), 0.2 * random.Gaussian()};
    knot.yaw_rad = 0.3 * i + 0.2 * random.Gaussian();
    knot.pitch_rad = 0.3 * random.Gaussian();
    knot.roll_rad = 0.3 * random.Gaussian();
    knot.liveliness = random.Uniform();
    plan.knots.push_back(knot);
  }
  plan.oscillations = WalkOscillations(7);
  plan.T_body_imu = {ExpSo3({0.3, -0.2, 1.1}), {0.3, -0.1, 1.5}};
  return plan;
}

// Returns the five-point central difference, whose error is of order h^4.
template <typename F>
auto Derivative(const F& f, double t) {
  const double h = 1e-3;
  return ((8.0 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12.0 * h)).eval();
}

TEST(Trajectory, VelocityAndAccelerationAreDerivativesOfPosition) {
  const Trajectory trajectory(LivelyPlan());
  const auto position = [&](double t) -> Vector3 {
    return trajectory.At(t).T_world_imu.translation;
  };
  const auto velocity = [&](double t) -> Vector3 { return trajectory.At(t).v_world_mps; };
  for (double t = 0.5; t < 7.0; t += 0.37) {
    EXPECT_LT((Derivative(position, t) - velocity(t)).norm(), 1e-7) << "at " << t;
    EXPECT_LT((Derivative(velocity, t) - trajectory.At(t).a_world_mps2).norm(), 1e-5) << "at " << t;
  }
}

TEST(Trajectory, RateIsTheDerivativeOfAttitude) {
  const Trajectory trajectory(LivelyPlan());
  for (double t = 0.5; t < 7.0; t += 0.37) {
    const Quaternion now = trajectory.At(t).T_world_imu.rotation;
    const auto turned = [&](double u) -> Vector3 {
      return LogSo3(now.conjugate() * trajectory.At(u).T_world_imu.rotation);
    };
    EXPECT_LT((Derivative(turned, t) - trajectory.At(t).w_imu_radps).norm(), 1e-7) << "at " << t;
  }
}

TEST(Trajectory, JerkAndItsRotationalLikeAreContinuousAcrossKnots) {
  const Trajectory trajectory(LivelyPlan());
  const auto step = [&](auto derivative, double t,
                        double h) {  // change of the next derivative across t
    return (((derivative(t + h) - derivative(t)) - (derivative(t) - derivative(t - h))) / h).norm();
  };
  const auto accel = [&](double t) -> Vector3 { return trajectory.At(t).a_world_mps2; };
  const auto rate = [&](double t) -> Vector3 { return trajectory.At(t).w_imu_radps; };
  for (int knot = 5; knot < 35; ++knot) {
    const double t = 0.2 * knot;
    // The change of a continuous function is proportional to h; a jump would stay.
    EXPECT_LT(step(accel, t, 1e-5), 0.2 * step(accel, t, 1e-4) + 1e-4) << "at " << t;
    EXPECT_LT(step(rate, t, 1e-5), 0.2 * step(rate, t, 1e-4) + 1e-5) << "at " << t;
  }
}

TEST(Trajectory, EqualKnotsMeanRest) {
  MotionPlan plan = LivelyPlan();
  for (std::size_t i = 0; i < 12; ++i) {
    plan.knots[i] = plan.knots[0];
    plan.knots[i].liveliness = 0.0;
  }
  const Trajectory trajectory(plan);
  for (double t = 0.0; t < 1.7; t += 0.1) {
    const Kinematics still = trajectory.At(t);
    EXPECT_LT(still.v_world_mps.norm(), 1e-12);
    EXPECT_LT(still.a_world_mps2.norm(), 1e-9);
    EXPECT_LT(still.w_imu_radps.norm(), 1e-12);
  }
}

TEST(Trajectory, ImuSitsAtItsLeverOnTheBody) {
  const MotionPlan plan = LivelyPlan();
  const Trajectory trajectory(plan);
  const Pose expected = trajectory.BodyPoseAt(3.3) * plan.T_body_imu;
  const Pose actual = trajectory.At(3.3).T_world_imu;
  EXPECT_LT((expected.translation - actual.translation).norm(), 1e-12);
  EXPECT_LT(expected.rotation.angularDistance(actual.rotation), 1e-12);
}

TEST(Trajectory, RefusesAPlanWithoutMotion) {
  EXPECT_THROW(Trajectory(MotionPlan{}), std::invalid_argument);
  MotionPlan plan = LivelyPlan();
  plan.knot_interval_s = 0.0;
  EXPECT_THROW(Trajectory{plan}, std::invalid_argument);
}

}  // namespace
}  // namespace lio::sim
