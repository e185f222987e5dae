// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/command_rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace lio {
namespace {

using ::testing::HasSubstr;

Command At(const Pose& pose) {
  Command command;
  command.action = CommandAction::kResetAtPose;
  command.T_world_imu = pose;
  return command;
}

Command Save(const std::string& name) {
  Command command;
  command.action = CommandAction::kSaveMap;
  command.name = name;
  return command;
}

TEST(CommandRules, APoseMustBeOne) {
  EXPECT_EQ(WhyUnusable(At({Quaternion(0.70711, 0.0, 0.0, 0.70711), {1.0, 2.0, 3.0}})), "");
  EXPECT_THAT(WhyUnusable(At({Quaternion(0.0, 0.0, 0.0, 0.0), Vector3::Zero()})),
              HasSubstr("quat"));
  EXPECT_THAT(WhyUnusable(At({Quaternion(NAN, 0.0, 0.0, 1.0), Vector3::Zero()})),
              HasSubstr("quat"));
  EXPECT_THAT(WhyUnusable(At({Quaternion::Identity(), {NAN, 0.0, 0.0}})), HasSubstr("pos"));
  EXPECT_THAT(WhyUnusable(At({Quaternion::Identity(), {1e6, 0.0, 0.0}})), HasSubstr("pos"));
}

TEST(CommandRules, ACovarianceMustBeOne) {
  Command command = At(Pose());
  command.pose_cov = Matrix6::Identity();
  EXPECT_EQ(WhyUnusable(command), "");
  command.pose_cov = Matrix6::Zero();
  EXPECT_EQ(WhyUnusable(command), "");
  (*command.pose_cov)(0, 1) = 0.1;
  EXPECT_THAT(WhyUnusable(command), HasSubstr("symmetric"));
  (*command.pose_cov)(1, 0) = 0.1;
  EXPECT_THAT(WhyUnusable(command), HasSubstr("negative"));
  (*command.pose_cov)(2, 2) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(WhyUnusable(command), HasSubstr("finite"));
}

TEST(CommandRules, AMapsNameIsAFileNameAndNoPath) {
  for (const char* name : {"map.pcd", "level-2_b.ply", "a.b.ply"}) {
    EXPECT_EQ(WhyUnusable(Save(name)), "") << name;
  }
  for (const char* name :
       {"", ".pcd", ".hidden.pcd", "map", "map.txt", "../map.pcd", "/tmp/map.pcd", "a/b.pcd",
        "a\\b.pcd", "a b.pcd", "..pcd", "a\n.pcd", "map.pcd/"}) {
    EXPECT_NE(WhyUnusable(Save(name)), "") << name;
  }
  EXPECT_NE(WhyUnusable(Save(std::string("a\0.pcd", 6))), "");
  EXPECT_NE(WhyUnusable(Save(std::string(61, 'a') + ".pcd")), "");
}

TEST(CommandRules, FieldsOfOtherActionsAreIgnored) {
  Command command = At({Quaternion(0.0, 0.0, 0.0, 0.0), {NAN, 0.0, 0.0}});
  command.name = "../..";
  command.action = CommandAction::kReset;
  EXPECT_EQ(WhyUnusable(command), "");
  command.action = static_cast<CommandAction>(7);
  EXPECT_EQ(WhyUnusable(command), "no action is 7");
  command.action = static_cast<CommandAction>(-1);
  EXPECT_NE(WhyUnusable(command), "");
}

TEST(CommandRules, ThePoseIsNormalized) {
  Command command = At({Quaternion(1.005, 0.0, 0.0, 0.0), {1.0, 2.0, 3.0}});
  EXPECT_EQ(PoseOf(command).T_world_imu.rotation.norm(), 1.0);
  EXPECT_TRUE(PoseOf(command).cov.isZero());
  command.pose_cov = Matrix6::Identity();
  EXPECT_EQ(PoseOf(command).cov, Matrix6::Identity());
}

}  // namespace
}  // namespace lio
