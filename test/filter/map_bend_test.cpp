// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/map_bend.hpp"

#include <gtest/gtest.h>

#include "lio/filter/estimate_change.hpp"
#include "lio/filter/pose_update.hpp"
#include "lio/filter/process_model.hpp"
#include "support/numeric_jacobian.hpp"
#include "support/random_state.hpp"
#include "support/state_error.hpp"

namespace lio {
namespace {

using test::BoxMinus;

// The estimate of a level body whose world and map agree; tilt and map have these variances, rad^2.
Estimate LevelEstimate(double tilt_var, double map_tilt_var) {
  Estimate estimate;
  estimate.cov.diagonal().segment<3>(kRot).setConstant(tilt_var);
  estimate.cov.diagonal().segment<3>(kMapPose + 3).setConstant(map_tilt_var);
  return estimate;
}

// Measures the tilt of the body in world about its x axis.
void MeasureTilt(double tilt_rad, double variance, Estimate& estimate) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(1, kStateDim);
  H(0, kRot) = 1.0;
  const double now_rad = LogSo3(estimate.state.T_world_imu.rotation).x();
  FuseLinear(estimate, H, Eigen::VectorXd::Constant(1, tilt_rad - now_rad),
             Eigen::MatrixXd::Constant(1, 1, variance));
}

void LetMapDrift(double variance, Estimate& estimate) {
  estimate.cov.block<3, 3>(kMapPose + 3, kMapPose + 3).diagonal().array() += variance;
}

TEST(MapBend, TheStartsErrorIsThatOfBothRotations) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 10; ++i) {
    Estimate estimate;
    estimate.state = test::RandomState(random);
    estimate.cov = test::RandomCovariance<kStateDim>(random, 0.01);
    Estimate marked = estimate;
    MarkMapStart(marked);
    // Returns the state after marking, by the errors of the state before it.
    const auto marked_error = [&](const Eigen::VectorXd& error) -> Eigen::VectorXd {
      Estimate other = estimate;
      other.state = BoxPlus(estimate.state, error);
      MarkMapStart(other);
      return BoxMinus(other.state, marked.state);
    };
    const Eigen::MatrixXd J = test::NumericJacobian(marked_error, ErrorVector::Zero());
    EXPECT_LT((marked.cov - J * estimate.cov * J.transpose()).norm(), 1e-6 * marked.cov.norm());
    EXPECT_LT(MapBend(marked.state).norm(), 1e-12);
  }
}

TEST(MapBend, ALevelledPoseHasLostItsShareOfTheBendAndNothingElse) {
  NavState state;
  state.T_world_imu = {ExpSo3(Vector3(0.1, -0.2, 1.3)), Vector3(1, 2, 3)};
  state.R_world_map_start = ExpSo3(Vector3(0.02, -0.01, 0.5));
  const Vector3 bend(0.003, -0.002, 0.004);  // world's axes, about the vertical too
  state.T_map_imu.rotation =
      (ExpSo3(bend) * state.R_world_map_start).conjugate() * state.T_world_imu.rotation;
  state.T_map_imu.translation = Vector3(-4, 5, 6);
  EXPECT_LT((MapBend(state) - Vector3(0.003, -0.002, 0)).norm(), 1e-5);
  for (const double share : {0.0, 0.25, 1.0}) {
    NavState level = state;
    level.T_map_imu = LevelMapPose(state, share);
    EXPECT_LT((MapBend(level) - (1 - share) * MapBend(state)).norm(), 1e-5) << share;
    EXPECT_EQ(level.T_map_imu.translation, state.T_map_imu.translation);
    const Vector3 turn = LogSo3(level.T_map_imu.rotation * state.T_map_imu.rotation.conjugate());
    EXPECT_NEAR(turn.norm(), share * MapBend(state).norm(), 1e-9);
  }
}

// The start was tilted, as the IMU learns afterwards: the map has not bent.
TEST(MapBend, ATiltThatTheStartAlreadyHadIsNoBend) {
  Estimate estimate = LevelEstimate(9e-6, 0.0);
  MarkMapStart(estimate);
  MeasureTilt(0.003, 1e-9, estimate);
  EXPECT_NEAR(LogSo3(estimate.state.T_world_imu.rotation).x(), 0.003, 1e-6);
  EXPECT_LT(MapBend(estimate.state).norm(), 1e-9);
}

// The start's tilt is known, so what the IMU learns later is the map's bend.
TEST(MapBend, ATiltThatCameAfterAKnownStartIsBend) {
  Estimate estimate = LevelEstimate(9e-6, 0.0);
  MarkMapStart(estimate);
  MeasureTilt(0.003, 1e-12, estimate);
  LetMapDrift(4e-6, estimate);
  // The pose in the map is measured and repeats: the body seems to have turned by a milliradian.
  PoseMeasurement measurement;
  measurement.T_map_imu.rotation = ExpSo3(Vector3(0.001, 0, 0));
  measurement.cov = 1e-12 * Matrix6::Identity();
  ASSERT_TRUE(FusePose(estimate, measurement, 1e9).fused);
  EXPECT_NEAR(MapBend(estimate.state).x(), -0.001, 1e-6);
}

// A tilt is that of the start or a bend since then, by their variances. The body may have turned
// unseen by 6e-6 rad^2 and the map drifted by as much; that the match repeats leaves 3e-6 of both.
TEST(MapBend, UnknownTiltIsSharedByVariance) {
  Estimate estimate = LevelEstimate(9e-6, 0.0);
  MarkMapStart(estimate);
  LetMapDrift(6e-6, estimate);
  Vector6 unseen_var = Vector6::Zero();
  unseen_var.tail<3>().setConstant(6e-6);
  AllowUnseenMotion(estimate, unseen_var, Vector3::Zero());
  PoseMeasurement measurement;
  measurement.cov = 1e-14 * Matrix6::Identity();
  ASSERT_TRUE(FusePose(estimate, measurement, 1e9).fused);
  MeasureTilt(0.002, 1e-14, estimate);
  EXPECT_NEAR(LogSo3(estimate.state.R_world_map_start).x(), 0.0015, 1e-6);
  EXPECT_NEAR(MapBend(estimate.state).x(), 0.0005, 1e-6);
}

// A scan inserted level makes the map a little straighter, and the filter knows by how much.
TEST(MapBend, TheMapPoseTakesTheShareOfAScanThatIsInsertedLevel) {
  Estimate estimate;
  estimate.state.T_map_imu.rotation = ExpSo3(Vector3(-0.002, 0, 0));
  estimate.cov.setIdentity();
  PoseMeasurement measurement;
  measurement.new_content_share = 0.1;
  Estimate as_it_is = estimate;
  BlendMapPose(as_it_is, measurement);
  EXPECT_NEAR(MapBend(as_it_is.state).x(), 0.002, 1e-9);
  measurement.is_level = true;
  BlendMapPose(estimate, measurement);
  EXPECT_NEAR(MapBend(estimate.state).x(), 0.9 * 0.002, 1e-9);
  EXPECT_EQ(estimate.cov, as_it_is.cov);
}

}  // namespace
}  // namespace lio
