// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/nav_state.hpp"

#include <gtest/gtest.h>

#include "support/numeric_jacobian.hpp"
#include "support/random_state.hpp"
#include "support/state_error.hpp"

namespace lio {
namespace {

using test::BoxMinus;

TEST(NavState, BoxMinusInvertsBoxPlus) {
  std::mt19937_64 random(1);
  for (const double size : {0.0, 1e-8, 1e-3, 0.3}) {
    const NavState state = test::RandomState(random);
    const ErrorVector error = size * test::RandomVector<kStateDim>(random);
    EXPECT_LT((BoxMinus(BoxPlus(state, error), state) - error).norm(), 1e-12) << size;
  }
}

TEST(NavState, BoxPlusInvertsBoxMinus) {
  std::mt19937_64 random(2);
  const NavState a = test::RandomState(random);
  const NavState b = test::RandomState(random);
  const ErrorVector left_over = BoxMinus(BoxPlus(b, BoxMinus(a, b)), a);
  EXPECT_LT(left_over.norm(), 1e-11);
}

TEST(NavState, InjectIsBoxPlusToFirstOrder) {
  std::mt19937_64 random(3);
  const NavState state = test::RandomState(random);
  const ErrorVector error = 1e-5 * test::RandomVector<kStateDim>(random);
  const ErrorVector apart = BoxMinus(Inject(state, error), BoxPlus(state, error));
  EXPECT_LT(apart.norm(), 1e-9);
  EXPECT_GT(apart.norm(), 0.0);
}

TEST(NavState, InjectMovesBothPosesAlike) {
  std::mt19937_64 random(4);
  const NavState state = test::RandomState(random);
  const Vector6 motion = test::RandomVector<6>(random);
  ErrorVector error = ErrorVector::Zero();
  error.segment<3>(kPos) = state.T_world_imu.rotation * motion.head<3>();
  error.segment<3>(kRot) = motion.tail<3>();
  error.segment<6>(kMapPose) = motion;
  const NavState moved = Inject(state, error);
  const Pose before = state.T_world_imu * state.T_map_imu.Inverse();
  const Pose after = moved.T_world_imu * moved.T_map_imu.Inverse();
  EXPECT_LT(LogSe3(before.Inverse() * after).norm(), 1e-12);
}

TEST(NavState, InjectJacobianMatchesDifferences) {
  std::mt19937_64 random(5);
  const NavState state = test::RandomState(random);
  const ErrorVector error = 0.5 * test::RandomVector<kStateDim>(random);
  const NavState after = Inject(state, error);
  const ErrorMatrix numeric = test::NumericJacobian(
      [&](const Eigen::VectorXd& e) -> Eigen::VectorXd {
        return BoxMinus(Inject(state, ErrorVector(e)), after);
      },
      error);
  EXPECT_LT((InjectJacobian(state, error) - numeric).norm(), 1e-6);
}

TEST(NavState, RotationErrorsActOnTheRight) {
  NavState state;
  state.T_world_imu.rotation = ExpSo3(Vector3(0, 0, M_PI / 2));
  ErrorVector error = ErrorVector::Zero();
  error.segment<3>(kRot) = Vector3(0.1, 0, 0);  // about the body's x axis, which is world's y
  const Vector3 turned_z = BoxPlus(state, error).T_world_imu.rotation * Vector3::UnitZ();
  EXPECT_NEAR(turned_z.x(), std::sin(0.1), 1e-12);
  EXPECT_NEAR(turned_z.y(), 0.0, 1e-12);
}

TEST(NavState, PositionErrorsAreInWorldAndMapPoseErrorsInTheBody) {
  NavState state;
  state.T_world_imu.rotation = state.T_map_imu.rotation = ExpSo3(Vector3(0, 0, M_PI / 2));
  ErrorVector error = ErrorVector::Zero();
  error[kPos] = 1.0;
  error[kMapPose] = 1.0;
  const NavState moved = BoxPlus(state, error);
  EXPECT_LT((moved.T_world_imu.translation - Vector3::UnitX()).norm(), 1e-12);
  EXPECT_LT((moved.T_map_imu.translation - Vector3::UnitY()).norm(), 1e-12);
}

}  // namespace
}  // namespace lio
