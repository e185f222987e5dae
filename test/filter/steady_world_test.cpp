// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/steady_world.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

namespace lio {
namespace {

using Mode = SteadyWorld::Mode;

// The filter far from the origin, its world turned against the map by `tilt_rad` about x.
Estimate TiltedBy(double tilt_rad, double tilt_std_rad) {
  Estimate estimate;
  estimate.state.T_map_imu = {ExpSo3(Vector3(0, 0, 0.4)), Vector3(100, 50, 0)};
  const Pose T_world_map{ExpSo3(Vector3(tilt_rad, 0, 0)), Vector3::Zero()};
  estimate.state.T_world_imu = T_world_map * estimate.state.T_map_imu;
  estimate.state.v_world_imu = Vector3(5, 0, 0);
  estimate.cov = 1e-4 * ErrorMatrix::Identity();
  estimate.cov.block<3, 3>(kRot, kRot) = tilt_std_rad * tilt_std_rad * Matrix3::Identity();
  return estimate;
}

Matrix6 PoseCovOf(const SteadyWorld::Published& published) {
  return published.cov.topLeftCorner<6, 6>();
}

double TiltOf(const SteadyWorld& world, const Estimate& estimate) {
  const Quaternion turn =
      world.Publish(estimate).T_world_imu.rotation * estimate.state.T_map_imu.rotation.conjugate();
  return LogSo3(turn).x();
}

constexpr double kSure_rad = 1e-3;
constexpr double kUnsure_rad = 0.02;

TEST(SteadyWorld, BeforeAnyScanTheFiltersWorldIsPublished) {
  const SteadyWorld world(Mode::kFromRest);
  const Estimate estimate = TiltedBy(0.01, kSure_rad);
  const SteadyWorld::Published published = world.Publish(estimate);
  EXPECT_EQ(published.T_world_imu.translation, estimate.state.T_world_imu.translation);
  EXPECT_EQ(PoseCovOf(published), PoseCov(estimate));
}

TEST(SteadyWorld, AfterAStartInMotionItFollowsUntilTheTiltIsKnown) {
  SteadyWorld world(Mode::kFromMotion);
  world.Update(TiltedBy(0.0, kUnsure_rad));
  world.Update(TiltedBy(0.01, kUnsure_rad));
  EXPECT_NEAR(TiltOf(world, TiltedBy(0.01, kUnsure_rad)), 0.01, 1e-12);
  world.Update(TiltedBy(0.01, kSure_rad));
  world.Update(TiltedBy(0.013, kUnsure_rad));
  EXPECT_NEAR(TiltOf(world, TiltedBy(0.013, kUnsure_rad)), 0.01, 1e-12) << "steady from then on";
}

TEST(SteadyWorld, SmallChangesOfTheTiltDoNotBendThePath) {
  SteadyWorld world(Mode::kFromRest);
  world.Update(TiltedBy(0.0, kSure_rad));
  const Vector3 before = world.Publish(TiltedBy(0.0, kSure_rad)).T_world_imu.translation;
  for (int i = 0; i < 100; ++i) world.Update(TiltedBy(0.003, kSure_rad));
  const Vector3 after = world.Publish(TiltedBy(0.003, kSure_rad)).T_world_imu.translation;
  EXPECT_LT((after - before).norm(), 1e-9) << "the filter's own would have moved by 15 cm";
}

TEST(SteadyWorld, SureErrorOfTheTiltIsTurnedSlowlyAboutTheVehicleUntilItIsTolerable) {
  SteadyWorld world(Mode::kFromRest);
  world.Update(TiltedBy(0.0, kSure_rad));
  const Estimate tilted = TiltedBy(0.02, kSure_rad);
  Vector3 last = world.Publish(tilted).T_world_imu.translation;
  for (int i = 0; i < 200; ++i) {
    const double before = TiltOf(world, tilted);
    world.Update(tilted);
    EXPECT_LE(std::abs(TiltOf(world, tilted) - before), 5.1e-4) << "a scan";
    const Vector3 here = world.Publish(tilted).T_world_imu.translation;
    EXPECT_LT((here - last).norm(), 1e-9) << "the vehicle stays where it is";
    last = here;
  }
  EXPECT_NEAR(TiltOf(world, tilted), 0.02 - SteadyWorld::kTolerance_rad, 1e-6);
}

TEST(SteadyWorld, CovarianceSaysWhatTheStepCosts) {
  SteadyWorld world(Mode::kFromRest);
  world.Update(TiltedBy(0.0, kSure_rad));
  const Estimate tilted = TiltedBy(0.003, kSure_rad);
  const SteadyWorld::Published published = world.Publish(tilted);
  Vector6 step;
  step << tilted.state.T_world_imu.translation - published.T_world_imu.translation,
      LogSo3(published.T_world_imu.rotation.conjugate() * tilted.state.T_world_imu.rotation);
  EXPECT_LT((PoseCovOf(published) - PoseCov(tilted) - step * step.transpose()).norm(), 1e-12);
  EXPECT_GT(step.head<3>().norm(), 0.1);
  EXPECT_NEAR((published.T_world_imu.rotation.conjugate() * published.v_world_imu -
               tilted.state.T_world_imu.rotation.conjugate() * tilted.state.v_world_imu)
                  .norm(),
              0.0, 1e-12)
      << "the body's own velocity is the same in both worlds";
}

TEST(SteadyWorld, FollowingPublishesTheFiltersWorldAtAllTimes) {
  SteadyWorld world(Mode::kFollow);
  world.Update(TiltedBy(0.0, kSure_rad));
  const Estimate tilted = TiltedBy(0.003, kSure_rad);
  world.Update(tilted);
  const SteadyWorld::Published published = world.Publish(tilted);
  EXPECT_LT((published.T_world_imu.translation - tilted.state.T_world_imu.translation).norm(),
            1e-9);
  EXPECT_LT((PoseCovOf(published) - PoseCov(tilted)).norm(), 1e-12);
}

}  // namespace
}  // namespace lio
