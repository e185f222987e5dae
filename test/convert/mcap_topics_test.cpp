// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/mcap_topics.hpp"

#include <gtest/gtest.h>

#include "support/ros_bag.hpp"

namespace lio {
namespace {

using test::RosBytes;

class McapTopicsTest : public testing::Test {
 protected:
  void AddSchema(std::uint16_t id, const std::string& name, const std::string& encoding,
                 const std::string& definition = "float64 x") {
    const RosBytes content =
        RosBytes().Put(id).PutString(name).PutString(encoding).PutString(definition);
    EXPECT_TRUE(topics_.AddSchema(content.bytes()));
  }
  void AddChannel(std::uint16_t id, std::uint16_t schema, const std::string& topic,
                  const std::string& encoding) {
    RosBytes content;
    content.Put(id).Put(schema).PutString(topic).PutString(encoding).Put(std::uint32_t{0});
    EXPECT_TRUE(topics_.AddChannel(content.bytes()));
  }

  McapTopics topics_;
};

TEST_F(McapTopicsTest, TypesOfBothRosVersionsHaveOneName) {
  AddSchema(1, "sensor_msgs/Imu", "ros1msg");
  AddSchema(2, "sensor_msgs/msg/Imu", "ros2msg");
  AddSchema(3, "sensor_msgs/msg/PointCloud2", "ros2idl");
  AddChannel(7, 1, "/one", "ros1");
  AddChannel(8, 2, "/two", "cdr");
  AddChannel(9, 3, "/three", "cdr");
  ASSERT_EQ(topics_.topics().size(), 3u);
  EXPECT_EQ(topics_.topics()[0].type, "sensor_msgs/Imu");
  EXPECT_EQ(topics_.topics()[0].encoding, RosEncoding::kRos1);
  EXPECT_EQ(topics_.topics()[1].type, "sensor_msgs/Imu");
  EXPECT_EQ(topics_.topics()[1].encoding, RosEncoding::kCdr);
  EXPECT_EQ(topics_.topics()[1].definition, "float64 x");
  EXPECT_EQ(topics_.topics()[2].type, "sensor_msgs/PointCloud2");
  EXPECT_EQ(topics_.topics()[2].definition, "") << "IDL is not understood";
}

TEST_F(McapTopicsTest, WhatIsNotRosIsNotTakenForIt) {
  AddSchema(1, "sensor_msgs/Imu", "protobuf");
  AddChannel(1, 1, "/a", "protobuf");
  AddChannel(2, 1, "/b", "ros1");
  AddChannel(3, 40, "/c", "json");
  EXPECT_EQ(topics_.topics()[0].type, "sensor_msgs/Imu as protobuf");
  EXPECT_EQ(topics_.topics()[1].type, "sensor_msgs/Imu as ros1");
  EXPECT_EQ(topics_.topics()[2].type, "unknown type as json");
}

TEST_F(McapTopicsTest, ChannelsOfOneTopicAreOneAndTheFirstOfAnIdCounts) {
  AddSchema(1, "a/B", "ros1msg");
  AddChannel(1, 1, "/a", "ros1");
  AddChannel(2, 1, "/a", "ros1");
  AddChannel(2, 1, "/other", "ros1");
  EXPECT_EQ(topics_.topics().size(), 1u);
  EXPECT_EQ(topics_.num_channels(), 2u);
  EXPECT_EQ(topics_.IndexOf(1), 0u);
  EXPECT_EQ(topics_.IndexOf(2), 0u);
  EXPECT_FALSE(topics_.IndexOf(3));
}

TEST_F(McapTopicsTest, WhatEndsInsideIsNoDefinition) {
  const auto schema = RosBytes().Put(std::uint16_t{1}).PutString("a/B").PutString("").bytes();
  EXPECT_FALSE(topics_.AddSchema(schema));
  EXPECT_FALSE(topics_.AddChannel({}));
}

TEST_F(McapTopicsTest, OnlySomeDefinitionsAreKept) {
  const std::string large(10 << 20, 'x');
  AddSchema(1, "a/B", "ros1msg", large);
  std::size_t num_kept = 0;
  for (std::uint16_t i = 1; i < 30; ++i) {
    AddChannel(i, 1, "/topic" + std::to_string(i), "ros1");
    num_kept += topics_.topics().back().definition.empty() ? 0 : 1;
  }
  EXPECT_EQ(topics_.topics().size(), 29u);
  EXPECT_EQ(num_kept, 5u);  // with the schema's own 60 MiB
}

}  // namespace
}  // namespace lio
