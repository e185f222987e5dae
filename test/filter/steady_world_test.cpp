// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/steady_world.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

const Vector3 kDown(0, 0, -9.81);

// The filter far from the origin, its world turned against the map by `tilt_rad` about x.
Estimate TiltedBy(double tilt_rad) {
  Estimate estimate;
  estimate.state.T_map_imu = {ExpSo3(Vector3(0, 0, 0.4)), Vector3(100, 50, 0)};
  const Pose T_world_map{ExpSo3(Vector3(tilt_rad, 0, 0)), Vector3::Zero()};
  estimate.state.T_world_imu = T_world_map * estimate.state.T_map_imu;
  estimate.state.v_world_imu = Vector3(5, 0, 0.1);
  estimate.cov = 1e-4 * ErrorMatrix::Identity();
  return estimate;
}

TEST(SteadyWorld, PoseStaysWhereItWasWhenTheTiltIsFoundToBeAnother) {
  const WorldEstimate before = InSteadyWorld(TiltedBy(0.0));
  const WorldEstimate after = InSteadyWorld(TiltedBy(0.02));
  EXPECT_EQ(after.T_world_imu.translation, before.T_world_imu.translation);
  EXPECT_EQ(after.T_world_imu.rotation.coeffs(), before.T_world_imu.rotation.coeffs());
  EXPECT_GT((TiltedBy(0.02).state.T_world_imu.translation - before.T_world_imu.translation).norm(),
            0.9)
      << "the filter's own has moved";
}

TEST(SteadyWorld, VelocityInTheBodyIsTheFilters) {
  const Estimate tilted = TiltedBy(0.02);
  const WorldEstimate steady = InSteadyWorld(tilted);
  EXPECT_LT((steady.T_world_imu.rotation.conjugate() * steady.v_world_imu -
             tilted.state.T_world_imu.rotation.conjugate() * tilted.state.v_world_imu)
                .norm(),
            1e-12);
}

TEST(SteadyWorld, WhereDownIsTurnsAlong) {
  const Estimate tilted = TiltedBy(0.02);
  const WorldEstimate steady = InSteadyWorld(tilted);
  const Vector3 down_imu = tilted.state.T_world_imu.rotation.conjugate() * kDown;
  EXPECT_LT(
      (steady.T_world_imu.rotation.conjugate() * (steady.R_world_filter * kDown) - down_imu).norm(),
      1e-12);
  EXPECT_NEAR((steady.R_world_filter * kDown).y(), -9.81 * std::sin(0.02), 1e-12);
}

TEST(SteadyWorld, CovarianceSaysWhatTheStepCosts) {
  const Estimate tilted = TiltedBy(0.003);
  const WorldEstimate steady = InSteadyWorld(tilted);
  Eigen::Matrix<double, kAccelBias, 1> step = Eigen::Matrix<double, kAccelBias, 1>::Zero();
  step.segment<3>(kPos) = tilted.state.T_world_imu.translation - steady.T_world_imu.translation;
  step.segment<3>(kRot) =
      LogSo3(steady.T_world_imu.rotation.conjugate() * tilted.state.T_world_imu.rotation);
  step.segment<3>(kVel) = tilted.state.v_world_imu - steady.v_world_imu;
  EXPECT_LT((steady.cov - InFilterWorld(tilted).cov - step * step.transpose()).norm(), 1e-12);
  EXPECT_GT(step.segment<3>(kPos).norm(), 0.1);
}

TEST(SteadyWorld, FiltersWorldIsPublishedAsItIs) {
  const Estimate tilted = TiltedBy(0.02);
  const WorldEstimate own = InFilterWorld(tilted);
  EXPECT_EQ(own.T_world_imu.translation, tilted.state.T_world_imu.translation);
  EXPECT_EQ(own.v_world_imu, tilted.state.v_world_imu);
  EXPECT_EQ(own.R_world_filter.coeffs(), Quaternion::Identity().coeffs());
  EXPECT_EQ(own.cov, (tilted.cov.topLeftCorner<kAccelBias, kAccelBias>()));
}

}  // namespace
}  // namespace lio
