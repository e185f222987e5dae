// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/world_yaw.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "support/random_state.hpp"

namespace lio {
namespace {

TEST(WorldYaw, IsTakenOutAndNothingElse) {
  std::mt19937_64 random(1);
  Estimate estimate;
  estimate.state = test::RandomState(random);
  const ErrorMatrix others = test::RandomCovariance<kStateDim>(random, 0.1);
  estimate.cov = others;
  (void)TakeOutYaw(estimate);
  const ErrorMatrix given_yaw = estimate.cov;
  // An unknown yaw turns position and velocity along.
  ErrorVector by_yaw = ErrorVector::Zero();
  by_yaw.segment<3>(kPos) = Vector3(3.0, -4.0, 0.0);
  by_yaw.segment<3>(kRot) = estimate.state.T_world_imu.rotation.conjugate() * Vector3::UnitZ();
  by_yaw.segment<3>(kVel) = Vector3(0.0, 8.0, 0.0);
  estimate.cov = given_yaw + 2.5 * by_yaw * by_yaw.transpose();
  EXPECT_NEAR(TakeOutYaw(estimate), 2.5, 1e-9);
  EXPECT_LT((estimate.cov - given_yaw).norm(), 1e-9);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<ErrorMatrix>(estimate.cov).eigenvalues().minCoeff(),
            -1e-12);
}

TEST(WorldYaw, AKnownOneHasNoVariance) {
  Estimate estimate;
  EXPECT_EQ(TakeOutYaw(estimate), 0.0);
  EXPECT_EQ(estimate.cov, ErrorMatrix::Zero());
}

}  // namespace
}  // namespace lio
