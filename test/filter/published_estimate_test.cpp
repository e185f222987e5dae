// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/published_estimate.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/numeric_jacobian.hpp"
#include "support/random_state.hpp"

namespace lio {
namespace {

using WorldError = Eigen::Matrix<double, kAccelBias, 1>;

// The filter is far from the origin, and its world is turned relative to the map by `tilt_rad`
// about x.
Estimate TiltedBy(double tilt_rad) {
  Estimate estimate;
  estimate.state.T_map_imu = {ExpSo3(Vector3(0, 0, 0.4)), Vector3(100, 50, 0)};
  const Pose T_world_map{ExpSo3(Vector3(tilt_rad, 0, 0)), Vector3::Zero()};
  estimate.state.T_world_imu = T_world_map * estimate.state.T_map_imu;
  estimate.state.v_world_imu = Vector3(5, 0, 0.1);
  estimate.cov = 1e-4 * ErrorMatrix::Identity();
  return estimate;
}

TEST(PublishedEstimate, TheWorldIsTheFilters) {
  const Estimate tilted = TiltedBy(0.02);
  const WorldEstimate own = InWorld(tilted);
  EXPECT_EQ(own.T_world_imu.translation, tilted.state.T_world_imu.translation);
  EXPECT_EQ(own.v_world_imu, tilted.state.v_world_imu);
  EXPECT_EQ(own.cov, (tilted.cov.topLeftCorner<kAccelBias, kAccelBias>()));
}

TEST(PublishedEstimate, TheMapStaysWhereItWasWhenTheTiltIsFoundToBeAnother) {
  const WorldEstimate before = WithMapAsWorld(TiltedBy(0.0));
  const WorldEstimate after = WithMapAsWorld(TiltedBy(0.02));
  EXPECT_EQ(after.T_world_imu.translation, before.T_world_imu.translation);
  EXPECT_EQ(after.T_world_imu.rotation.coeffs(), before.T_world_imu.rotation.coeffs());
  EXPECT_GT(
      (InWorld(TiltedBy(0.02)).T_world_imu.translation - before.T_world_imu.translation).norm(),
      0.9)
      << "the filter's own has moved";
}

TEST(PublishedEstimate, TheCovarianceSaysWhatTheStepBetweenThemCosts) {
  const Estimate tilted = TiltedBy(0.003);
  const WorldEstimate world = InWorld(tilted);
  const WorldEstimate map = WithMapAsWorld(tilted);
  WorldError step = WorldError::Zero();
  step.segment<3>(kPos) = world.T_world_imu.translation - map.T_world_imu.translation;
  step.segment<3>(kRot) = LogSo3(map.T_world_imu.rotation.conjugate() * world.T_world_imu.rotation);
  step.segment<3>(kVel) = world.v_world_imu - map.v_world_imu;
  EXPECT_LT((map.cov - world.cov - step * step.transpose()).norm(), 1e-12);
  EXPECT_GT(step.segment<3>(kPos).norm(), 0.1);
}

TEST(PublishedEstimate, TheVelocityInTheBodyIsTheSameInBoth) {
  const Estimate tilted = TiltedBy(0.02);
  const NavState& state = tilted.state;
  const Vector3 v_map = VelocityInMap(tilted).v_map_imu;
  EXPECT_LT((state.T_map_imu.rotation.conjugate() * v_map -
             state.T_world_imu.rotation.conjugate() * state.v_world_imu)
                .norm(),
            1e-12);
  EXPECT_LT((v_map - WithMapAsWorld(tilted).v_world_imu).norm(), 1e-12);
}

TEST(PublishedEstimate, TheVelocitysCovarianceInMapIsThatOfSmallErrors) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 20; ++i) {
    Estimate estimate;
    estimate.state = test::RandomState(random);
    estimate.cov = test::RandomCovariance<kStateDim>(random, 0.01);
    const auto v_map = [&](const Eigen::VectorXd& error) -> Eigen::VectorXd {
      Estimate other = estimate;
      other.state = BoxPlus(estimate.state, error);
      return VelocityInMap(other).v_map_imu;
    };
    const Eigen::MatrixXd J = test::NumericJacobian(v_map, ErrorVector::Zero());
    const Matrix3 numeric = J * estimate.cov * J.transpose();
    EXPECT_LT((VelocityInMap(estimate).cov - numeric).norm(), 1e-5 * numeric.norm());
  }
}

}  // namespace
}  // namespace lio
