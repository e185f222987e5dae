// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lio/convert/rosbag_convert.hpp"
#include "lio/io/input_error.hpp"

namespace lio {
namespace {

using testing::HasSubstr;

const BagTopic kPoints{"/points", "sensor_msgs/PointCloud2", "", RosEncoding::kRos1, 0};
const BagTopic kLeft{"/left", "sensor_msgs/PointCloud2", "", RosEncoding::kRos1, 0};
const BagTopic kImu{"/imu", "sensor_msgs/Imu", "", RosEncoding::kRos1, 0};
const BagTopic kImu2{"/imu2", "sensor_msgs/Imu", "", RosEncoding::kRos1, 0};
const BagTopic kOdometry{"/odom", "nav_msgs/Odometry", "", RosEncoding::kRos1, 0};
const BagTopic kPose{"/pose", "geometry_msgs/PoseStamped", "", RosEncoding::kRos1, 0};
const BagTopic kLivox{"/livox", "livox_ros_driver2/CustomMsg", "", RosEncoding::kRos1, 0};

template <typename Error>
std::string Refusal(const std::vector<BagTopic>& topics, const RosbagOptions& options = {}) {
  try {
    (void)ChooseTopics(topics, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "not refused";
}

TEST(ChooseTopics, FindsThemByType) {
  RosbagOptions options;
  options.truth_file = "t.tum";
  const TopicChoice choice = ChooseTopics({kOdometry, kImu, kPoints}, options);
  EXPECT_EQ(choice.lidar, "/points");
  EXPECT_EQ(choice.imu, "/imu");
  EXPECT_EQ(choice.truth, "/odom");
}

TEST(ChooseTopics, TakesNoTruthUnasked) {
  EXPECT_FALSE(ChooseTopics({kOdometry, kPose, kPoints}, {}).truth);
  EXPECT_FALSE(ChooseTopics({kPoints}, {}).imu);
}

TEST(ChooseTopics, ListsAmbiguousOnes) {
  EXPECT_THAT(Refusal<UsageError>({kPoints, kLeft, kImu}),
              testing::AllOf(HasSubstr("--lidar-topic"), HasSubstr("/points"), HasSubstr("/left")));
  EXPECT_THAT(Refusal<UsageError>({kPoints, kImu, kImu2}),
              testing::AllOf(HasSubstr("--imu-topic"), HasSubstr("/imu2")));
  RosbagOptions options;
  options.truth_file = "t.tum";
  EXPECT_THAT(Refusal<UsageError>({kPoints, kOdometry, kPose}, options),
              HasSubstr("--truth-topic"));
}

TEST(ChooseTopics, TakesNamedOnes) {
  RosbagOptions options;
  options.lidar_topic = "/left";
  options.imu_topic = "/imu2";
  const TopicChoice choice = ChooseTopics({kPoints, kLeft, kImu, kImu2}, options);
  EXPECT_EQ(choice.lidar, "/left");
  EXPECT_EQ(choice.imu, "/imu2");
}

TEST(ChooseTopics, RefusesWrongNamesAndTypes) {
  RosbagOptions options;
  options.lidar_topic = "/nope";
  EXPECT_THAT(Refusal<UsageError>({kPoints}, options), HasSubstr("no such topic"));
  options.lidar_topic = "/imu";
  EXPECT_THAT(Refusal<UsageError>({kPoints, kImu}, options), HasSubstr("sensor_msgs/Imu"));
}

TEST(ChooseTopics, TakesLivoxMessagesAsScans) {
  RosbagOptions options;
  EXPECT_EQ(ChooseTopics({kLivox, kImu}, options).lidar, "/livox");
  EXPECT_THAT(Refusal<UsageError>({kLivox, kPoints}), HasSubstr("livox_ros_driver2/CustomMsg"));
  options.lidar_topic = "/livox";
  EXPECT_EQ(ChooseTopics({kLivox, kPoints}, options).lidar, "/livox");
}

TEST(ChooseTopics, SaysWhatThereIsInsteadOfClouds) {
  EXPECT_THAT(Refusal<InputError>({kImu}), HasSubstr("/imu (sensor_msgs/Imu)"));
  EXPECT_THAT(Refusal<InputError>({}), HasSubstr("none"));
  RosbagOptions options;
  options.truth_file = "t.tum";
  EXPECT_THAT(Refusal<InputError>({kPoints}, options), HasSubstr("--truth"));
}

}  // namespace
}  // namespace lio
