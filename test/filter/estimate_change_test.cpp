// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/estimate_change.hpp"

#include <gtest/gtest.h>

#include "support/random_state.hpp"
#include "support/state_error.hpp"

namespace lio {
namespace {

using test::BoxMinus;

TEST(EstimateChange, UnseenMotionIsThatOfBothPoses) {
  const Vector6 motion_var = (Vector6() << 0.04, 0.09, 0.16, 1e-4, 4e-4, 9e-4).finished();
  const Vector3 velocity_var(1, 4, 9);
  Estimate estimate;
  estimate.state.T_world_imu.rotation = ExpSo3(Vector3(0.3, -0.7, 1.9));
  estimate.state.T_map_imu.rotation = ExpSo3(Vector3(0.1, 0.2, -0.5));
  AllowUnseenMotion(estimate, motion_var, velocity_var);
  const Matrix3 R = estimate.state.T_world_imu.rotation.toRotationMatrix();
  Eigen::Matrix<double, 6, kStateDim> apart = Eigen::Matrix<double, 6, kStateDim>::Zero();
  apart.block<3, 3>(0, kPos) = R.transpose();
  apart.block<3, 3>(3, kRot).setIdentity();
  apart.block<6, 6>(0, kMapPose) -= Matrix6::Identity();
  EXPECT_LT((apart * estimate.cov * apart.transpose()).norm(), 1e-12);
  const Matrix6 of_map = estimate.cov.block<6, 6>(kMapPose, kMapPose);
  EXPECT_LT((of_map - Matrix6(motion_var.asDiagonal())).norm(), 1e-12);
  const Matrix3 of_velocity = R.transpose() * estimate.cov.block<3, 3>(kVel, kVel) * R;
  EXPECT_LT((of_velocity - Matrix3(velocity_var.asDiagonal())).norm(), 1e-12);
}

// The map pose moves to where it is told, and the world's pose in map stays what it was, nominal
// value and error alike.
TEST(EstimateChange, MovingToAPoseKeepsWorldAndMapTogether) {
  std::mt19937_64 random(7);
  Estimate estimate;
  estimate.state = test::RandomState(random);
  const NavState before = estimate.state;
  const auto T_world_map = [](const NavState& state) {
    return state.T_world_imu * state.T_map_imu.Inverse();
  };
  const Pose there = before.T_map_imu * ExpSe3(3.0 * test::RandomVector<6>(random));
  ErrorVector error = ErrorVector::Zero();
  error.segment<6>(0) = 1e-5 * test::RandomVector<6>(random);
  error.segment<6>(kMapPose) = 1e-5 * test::RandomVector<6>(random);
  estimate.cov = error * error.transpose();
  MoveTo(there, estimate);
  EXPECT_LT(LogSe3(estimate.state.T_map_imu.Inverse() * there).norm(), 1e-9);
  EXPECT_LT(LogSe3(T_world_map(before).Inverse() * T_world_map(estimate.state)).norm(), 1e-9);
  NavState moved = BoxPlus(before, error);  // the truth moves by the same increment
  const Pose increment = before.T_map_imu.Inverse() * there;
  moved.T_world_imu = moved.T_world_imu * increment;
  moved.T_map_imu = moved.T_map_imu * increment;
  const ErrorVector error_after = BoxMinus(moved, estimate.state);
  for (const int at : {kPos, kRot, kMapPose, kMapPose + 3}) {
    const Matrix3 expected = error_after.segment<3>(at) * error_after.segment<3>(kPos).transpose();
    EXPECT_LT((estimate.cov.block<3, 3>(at, kPos) - expected).norm(), 1e-12) << at;
  }
}

TEST(EstimateChange, VelocityThatIsSetTurnsWithTheErrorOfTheRotation) {
  std::mt19937_64 random(8);
  Estimate estimate;
  estimate.state = test::RandomState(random);
  const Vector3 turn = 1e-4 * test::RandomVector<3>(random);
  estimate.cov.block<3, 3>(kRot, kRot) = turn * turn.transpose();
  estimate.cov.block<3, 3>(kVel, kVel) = 100.0 * Matrix3::Identity();
  const Vector3 v_imu_mps(5, 1, -2);
  SetVelocity(v_imu_mps, Matrix3::Zero(), estimate);
  const Quaternion R = estimate.state.T_world_imu.rotation;
  EXPECT_LT((estimate.state.v_world_imu - R * v_imu_mps).norm(), 1e-12);
  const Vector3 by_turn = R * (ExpSo3(turn) * v_imu_mps) - R * v_imu_mps;
  const Matrix3 of_velocity = estimate.cov.block<3, 3>(kVel, kVel);
  EXPECT_LT((of_velocity - by_turn * by_turn.transpose()).norm(), 1e-9);
}

}  // namespace
}  // namespace lio
