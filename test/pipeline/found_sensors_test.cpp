// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/found_sensors.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

const Pose kFound{Quaternion::Identity(), Vector3(1.0, 2.0, 3.0)};

TEST(FoundSensors, WhatWasFoundOverridesTheRigAndIsKnownAsWell) {
  Options given;
  given.rig.T_imu_lidar.emplace().std_m = 0.5;
  given.rig.lidar.clock_offset_s = 0.1;
  FoundSensors found;
  found.T_imu_lidar = kFound;
  found.clock.mean[0] = 0.02;
  const Options options = WithFound(given, found);
  EXPECT_EQ(options.rig.T_imu_lidar->translation, kFound.translation);
  EXPECT_EQ(options.rig.T_imu_lidar->std_m, 0.5);
  EXPECT_DOUBLE_EQ(options.rig.lidar.clock_offset_s, 0.12);
}

TEST(FoundSensors, NothingFoundChangesNothing) {
  const Options options = WithFound({}, {});
  EXPECT_FALSE(options.rig.T_imu_lidar);
  EXPECT_EQ(options.rig.lidar.clock_offset_s, 0.0);
}

TEST(FoundSensors, InAxesOfTheMessagesTheMountingIsTurnedAndTheMessagesAreNot) {
  Rig rig;
  rig.T_imu_lidar = Pose{Quaternion::Identity(), Vector3(1.0, 2.0, 3.0)};
  FoundSensors found;
  EXPECT_FALSE(InAxesOfMessages(found, rig).T_imu_lidar);
  found.convention.emplace();
  EXPECT_FALSE(InAxesOfMessages(found, rig).T_imu_lidar) << "they have the rig's axes";
  found.convention->R_imu_sent << 0, -1, 0, 1, 0, 0, 0, 0, 1;  // x of the messages is the rig's y
  found.extrinsic_std = ExtrinsicStd{Vector3(0.1, 0.2, 0.3), Vector3(1.0, 2.0, 3.0)};
  const FoundSensors of_messages = InAxesOfMessages(found, rig);
  EXPECT_EQ(of_messages.convention->R_imu_sent, Matrix3::Identity());
  ASSERT_TRUE(of_messages.T_imu_lidar);
  EXPECT_TRUE(of_messages.T_imu_lidar->translation.isApprox(Vector3(2.0, -1.0, 3.0)));
  EXPECT_TRUE((of_messages.T_imu_lidar->rotation * Vector3::UnitY()).isApprox(Vector3::UnitX()));
  ASSERT_TRUE(of_messages.extrinsic_std);
  EXPECT_EQ(of_messages.extrinsic_std->rotation_rad, Vector3(0.2, 0.1, 0.3));
  EXPECT_EQ(of_messages.extrinsic_std->lever_m, Vector3(2.0, 1.0, 3.0));
}

TEST(FoundSensors, ARigWithoutExtrinsicGetsTheFoundOne) {
  FoundSensors found;
  found.T_imu_lidar = kFound;
  EXPECT_EQ(WithFound({}, found).rig.T_imu_lidar->translation, kFound.translation);
}

}  // namespace
}  // namespace lio
