// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/extrinsic_correction.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "lio/filter/map_bend.hpp"
#include "support/numeric_jacobian.hpp"
#include "support/random_state.hpp"

namespace lio {
namespace {

const Vector3 kRate_radps(0.3, -0.2, 0.5);
const Pose kOldNew{ExpSo3(Vector3(0.05, -0.03, 0.09)), Vector3(0.2, -0.1, 0.3)};

Estimate RandomEstimate() {
  std::mt19937_64 random(3);
  Estimate estimate;
  estimate.state = test::RandomState(random);
  estimate.cov = test::RandomCovariance<kStateDim>(random, 0.01);
  return estimate;
}

Estimate Corrected(Estimate estimate, const Pose& T_old_new = kOldNew) {
  CorrectExtrinsic(T_old_new, kRate_radps, {0.005, 0.05}, estimate);
  return estimate;
}

// The lidar is where it was, and both bodies are rigid to it.
TEST(ExtrinsicCorrection, TheVelocityIsThatOfTheOtherBody) {
  const Estimate before = RandomEstimate();
  const Estimate after = Corrected(before);
  EXPECT_LT(LogSe3((before.state.T_map_imu * kOldNew).Inverse() * after.state.T_map_imu).norm(),
            1e-9);
  // This gives the pose of the old body a moment later, by its velocity and rate, and that of the
  // new one.
  static constexpr double kMoment_s = 1e-4;
  const auto moved = [](const NavState& state, const Vector3& w_imu_radps) {
    const Vector3 v_imu = state.T_world_imu.rotation.conjugate() * state.v_world_imu;
    Vector6 twist;
    twist << v_imu, w_imu_radps;
    return state.T_map_imu * ExpSe3(kMoment_s * twist);
  };
  const Pose old_later = moved(before.state, kRate_radps);
  const Pose new_later = moved(after.state, kOldNew.rotation.conjugate() * kRate_radps);
  EXPECT_LT(LogSe3((old_later * kOldNew).Inverse() * new_later).norm(), 1e-9);
}

TEST(ExtrinsicCorrection, ThePathInWorldGoesOnAndTheTiltStays) {
  const Estimate before = RandomEstimate();
  const Estimate after = Corrected(before);
  EXPECT_EQ(after.state.T_world_imu.translation, before.state.T_world_imu.translation);
  const auto up_imu = [](const Estimate& estimate) -> Vector3 {
    return estimate.state.T_world_imu.rotation.conjugate() * Vector3::UnitZ();
  };
  EXPECT_LT((up_imu(after) - up_imu(before)).norm(), 1e-12);
}

// The direction of travel keeps its yaw in world when the correction is one of yaw.
TEST(ExtrinsicCorrection, AYawTurnsTheBodyAndNotItsPath) {
  Estimate before;
  before.state.v_world_imu = Vector3(8.0, 0.0, 0.0);
  Estimate after = before;
  CorrectExtrinsic({ExpSo3(Vector3(0.0, 0.0, 0.1)), Vector3::Zero()}, Vector3::Zero(), {}, after);
  EXPECT_LT((after.state.v_world_imu - before.state.v_world_imu).norm(), 1e-12);
  EXPECT_NEAR(LogSo3(after.state.T_world_imu.rotation).z(), 0.1, 1e-12);
}

TEST(ExtrinsicCorrection, TheMapPosesCovarianceIsThatOfTheOtherBody) {
  const Estimate before = RandomEstimate();
  const Estimate after = Corrected(before);
  const auto moved_error = [&](const Eigen::VectorXd& error) -> Eigen::VectorXd {
    const Pose other = before.state.T_map_imu * ExpSe3(Vector6(error));
    return LogSe3(after.state.T_map_imu.Inverse() * (other * kOldNew));
  };
  const Eigen::MatrixXd J = test::NumericJacobian(moved_error, Vector6::Zero());
  const Matrix6 expected = J * before.cov.block<6, 6>(kMapPose, kMapPose) * J.transpose();
  const Matrix6 found = after.cov.block<6, 6>(kMapPose, kMapPose);
  EXPECT_LT((found - expected).norm(), 1e-6 * expected.norm());
}

TEST(ExtrinsicCorrection, WhatTheContradictionHasBentIsForgotten) {
  const Estimate after = Corrected(RandomEstimate());
  EXPECT_TRUE(after.state.gyro_bias.isZero());
  EXPECT_TRUE(after.state.accel_bias.isZero());
  EXPECT_EQ(after.cov(kGyroBias, kGyroBias), 0.005 * 0.005);
  EXPECT_EQ(after.cov(kAccelBias + 2, kAccelBias + 2), 0.05 * 0.05);
  EXPECT_EQ(after.cov(kVel, kVel), 1.0);
  EXPECT_LT(MapBend(after.state).norm(), 1e-12);
  const Eigen::SelfAdjointEigenSolver<ErrorMatrix> solver(after.cov);
  EXPECT_GT(solver.eigenvalues().minCoeff(), -1e-12);
}

}  // namespace
}  // namespace lio
