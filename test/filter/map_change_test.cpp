// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/map_change.hpp"

#include <gtest/gtest.h>

#include <random>

#include "lio/filter/map_bend.hpp"
#include "support/random_state.hpp"
#include "support/state_error.hpp"

namespace lio {
namespace {

using test::BoxMinus;

const Pose kToMap{ExpSo3(Vector3(0, 0, 2.1)), Vector3(40, -7, 3)};

// A body in a level world that is the map, leaning a little.
Estimate SomeEstimate() {
  Estimate estimate;
  NavState& state = estimate.state;
  state.T_world_imu = {ExpSo3(Vector3(0, 0, 0.4)) * ExpSo3(Vector3(0.05, -0.03, 0)),
                       Vector3(3, 4, 0.5)};
  state.T_map_imu = state.T_world_imu;
  state.v_world_imu = Vector3(5, 1, 0.2);
  state.gyro_bias = Vector3(0.01, 0.02, 0.03);
  estimate.cov.diagonal().setConstant(1e-4);
  return estimate;
}

TEST(MapChange, WorldAndMapBecomeTheNewMap) {
  const Estimate before = SomeEstimate();
  Estimate after = before;
  ChangeMap(kToMap, Matrix6::Zero(), after);
  const Pose expected = kToMap * before.state.T_map_imu;
  for (const Pose& pose : {after.state.T_map_imu, after.state.T_world_imu}) {
    EXPECT_LT(LogSe3(expected.Inverse() * pose).norm(), 1e-9);
  }
  EXPECT_LT((after.state.v_world_imu - kToMap.rotation * before.state.v_world_imu).norm(), 1e-9);
  EXPECT_EQ(after.state.gyro_bias, before.state.gyro_bias);
  EXPECT_LT(MapBend(after.state).norm(), 1e-9);
}

// A map that was saved with a lean: the pose in it leans, the world stays level.
TEST(MapChange, TheWorldStaysLevelInAMapThatIsNot) {
  const Estimate before = SomeEstimate();
  Estimate after = before;
  const Pose leaning{kToMap.rotation * ExpSo3(Vector3(0.1, 0, 0)), kToMap.translation};
  ChangeMap(leaning, Matrix6::Zero(), after);
  const auto up_imu = [](const NavState& state) -> Vector3 {
    return state.T_world_imu.rotation.conjugate() * Vector3::UnitZ();
  };
  EXPECT_LT((up_imu(after.state) - up_imu(before.state)).norm(), 1e-9);
  EXPECT_EQ(after.state.T_world_imu.translation, after.state.T_map_imu.translation);
  EXPECT_LT(MapBend(after.state).norm(), 1e-9) << "the lean is the map's own, no bend";
}

// The error of the place is one of the pose in world, of its velocity and of the pose in map at
// once: against numeric differences.
TEST(MapChange, TheErrorOfThePlaceIsOneOfAllThatMovesWithIt) {
  Estimate exact = SomeEstimate();
  exact.cov.setZero();
  Matrix6 cov = Matrix6::Zero();
  cov.diagonal() << 0.04, 0.01, 0.02, 1e-4, 2e-4, 3e-4;
  Estimate changed = exact;
  ChangeMap(kToMap, cov, changed);
  const Pose T_map_imu = kToMap * exact.state.T_map_imu;
  ErrorMatrix expected = ErrorMatrix::Zero();
  for (int i = 0; i < 6; ++i) {
    constexpr double kStep = 1e-6;
    Vector6 error = Vector6::Zero();
    error[i] = kStep;
    Estimate moved = exact;
    ChangeMap(T_map_imu * ExpSe3(error) * exact.state.T_map_imu.Inverse(), Matrix6::Zero(), moved);
    const ErrorVector by = BoxMinus(moved.state, changed.state) / kStep;
    expected += cov(i, i) * by * by.transpose();
  }
  EXPECT_LT((changed.cov - expected).cwiseAbs().maxCoeff(), 1e-3 * expected.diagonal().maxCoeff());
}

}  // namespace
}  // namespace lio
