// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/extrinsic_follower.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

Pose Shifted(double x_m) {
  return {Quaternion::Identity(), Vector3(x_m, 0.0, 0.0)};
}

Options OptionsOfExtrinsic(bool estimates) {
  Options options;
  options.rig.T_imu_lidar = Shifted(1.0);
  options.filter.estimate_extrinsic = estimates;
  return options;
}

RigFindings Wrong(double right_x_m) {
  RigFindings findings;
  findings.T_imu_lidar = Shifted(right_x_m);
  return findings;
}

RigFindings Bettered(double right_x_m) {
  RigFindings findings;
  findings.T_imu_lidar_bettered = Shifted(right_x_m);
  return findings;
}

TEST(ExtrinsicFollower, TheRigsIsUsedUntilItIsSurelyWrong) {
  ExtrinsicFollower follower(OptionsOfExtrinsic(true));
  EXPECT_FALSE(follower.Take({}));
  EXPECT_FALSE(follower.Take(Bettered(1.01)));
  EXPECT_EQ(follower.T_imu_lidar().translation.x(), 1.0);
  EXPECT_FALSE(follower.corrected());
  const auto T_old_new = follower.Take(Wrong(0.4));
  ASSERT_TRUE(T_old_new);
  EXPECT_NEAR(T_old_new->translation.x(), 0.6, 1e-12);  // the lidar is 0.4 m from the new imu
  EXPECT_EQ(follower.T_imu_lidar().translation.x(), 0.4);
  ASSERT_TRUE(follower.corrected());
  EXPECT_EQ(follower.corrected()->translation.x(), 0.4);
}

TEST(ExtrinsicFollower, WhatWasCorrectedIsBettered) {
  ExtrinsicFollower follower(OptionsOfExtrinsic(true));
  ASSERT_TRUE(follower.Take(Wrong(0.4)));
  ASSERT_TRUE(follower.Take(Bettered(0.38)));
  EXPECT_EQ(follower.T_imu_lidar().translation.x(), 0.38);
  EXPECT_FALSE(follower.Take({}));
}

TEST(ExtrinsicFollower, WhatWasFoundIsKnownAsTheLastLookKnowsIt) {
  ExtrinsicFollower follower(OptionsOfExtrinsic(true));
  RigFindings findings;
  findings.extrinsic_std = ExtrinsicStd{Vector3::Constant(0.01), Vector3::Constant(0.1)};
  (void)follower.Take(findings);
  EXPECT_FALSE(follower.std()) << "the rig's is in use";
  RigFindings wrong = Wrong(0.4);
  wrong.extrinsic_std = findings.extrinsic_std;
  ASSERT_TRUE(follower.Take(wrong));
  EXPECT_EQ(follower.std()->lever_m, Vector3::Constant(0.1));
  findings.extrinsic_std->lever_m = Vector3::Constant(0.05);
  EXPECT_FALSE(follower.Take(findings));
  EXPECT_EQ(follower.std()->lever_m, Vector3::Constant(0.05));
  follower.Restart();
  EXPECT_FALSE(follower.std());
}

TEST(ExtrinsicFollower, AnEarlierPassTellsHowWellItFoundIt) {
  const ExtrinsicStd found{Vector3::Constant(0.001), Vector3::Constant(0.01)};
  ExtrinsicFollower follower(OptionsOfExtrinsic(true), found);
  ASSERT_TRUE(follower.std());
  EXPECT_EQ(follower.std()->lever_m, found.lever_m);
  follower.Restart();
  EXPECT_TRUE(follower.std());
}

TEST(ExtrinsicFollower, NothingIsCorrectedWhereThatIsOffOrThereIsNoImu) {
  Options without_imu = OptionsOfExtrinsic(true);
  without_imu.pipeline.use_imu = false;
  for (const Options& options : {OptionsOfExtrinsic(false), without_imu}) {
    ExtrinsicFollower follower(options);
    EXPECT_FALSE(follower.Take(Wrong(0.4)));
    EXPECT_EQ(follower.T_imu_lidar().translation.x(), 1.0);
  }
}

TEST(ExtrinsicFollower, ARestartGoesBackToTheRigs) {
  ExtrinsicFollower follower(OptionsOfExtrinsic(true));
  ASSERT_TRUE(follower.Take(Wrong(0.4)));
  follower.Restart();
  EXPECT_EQ(follower.T_imu_lidar().translation.x(), 1.0);
  EXPECT_FALSE(follower.Take(Bettered(0.38)));
}

}  // namespace
}  // namespace lio
