// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/ros_schema.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>

#include "support/ros_bag.hpp"

namespace lio {
namespace {

using test::RosBytes;

constexpr const char* kNestedDefinition = R"(# what it is
Header header   # when
uint8 GOOD = 3
Status status
float64[3] position
uint16[] samples
string name
int32 last
================================================================================
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
================================================================================
MSG: my_msgs/Status
uint8[4] bytes
bool ok
)";

RosBytes NestedMessage() {
  RosBytes bytes;
  bytes.PutHeader(Timestamp{1'500'000'000}, "frame");
  for (int i = 1; i <= 4; ++i) bytes.Put(static_cast<std::uint8_t>(i));
  bytes.Put(std::uint8_t{1});
  for (double v : {1.5, 2.5, 3.5}) bytes.Put(v);
  bytes.Put(std::uint32_t{2}).Put(std::uint16_t{11}).Put(std::uint16_t{12});
  bytes.PutString("ignored").Put(std::int32_t{-42});
  return bytes;
}

TEST(RosSchema, ReadsNestedFieldsArraysAndTimes) {
  const auto schema = RosSchema::Parse(kNestedDefinition, "my_msgs/Thing");
  ASSERT_TRUE(schema);
  const auto numbers = schema->Read(NestedMessage().bytes(), RosEncoding::kRos1);
  ASSERT_TRUE(numbers);
  EXPECT_EQ(numbers->at("header.stamp"), 1.5);
  EXPECT_EQ(numbers->at("status.bytes[0]"), 1.0);
  EXPECT_EQ(numbers->at("status.bytes[3]"), 4.0);
  EXPECT_EQ(numbers->at("status.ok"), 1.0);
  EXPECT_EQ(numbers->at("position[2]"), 3.5);
  EXPECT_EQ(numbers->at("samples[1]"), 12.0);
  EXPECT_EQ(numbers->at("last"), -42.0);
}

TEST(RosSchema, RefusesEveryTruncation) {
  const auto schema = RosSchema::Parse(kNestedDefinition, "my_msgs/Thing");
  const auto message = NestedMessage().bytes();
  for (std::size_t size = 0; size < message.size(); ++size) {
    EXPECT_FALSE(schema->Read(ByteView(message).first(size), RosEncoding::kRos1)) << size;
  }
}

TEST(RosSchema, ReadsRos2TimesAsMessages) {
  const auto schema = RosSchema::Parse(
      "std_msgs/Header header\nfloat32 x 1.0\n===\nMSG: std_msgs/Header\n"
      "builtin_interfaces/Time stamp\nstring<=10 frame_id\n===\nMSG: builtin_interfaces/Time\n"
      "int32 sec\nuint32 nanosec\n",
      "a/msg/B");
  ASSERT_TRUE(schema);
  RosBytes bytes(RosEncoding::kCdr, true);
  bytes.PutHeader(Timestamp{2'000'000'005}, "f").Put(0.5f);
  const auto numbers = schema->Read(bytes.bytes(), RosEncoding::kCdr);
  ASSERT_TRUE(numbers);
  EXPECT_EQ(numbers->at("header.stamp.sec"), 2.0);
  EXPECT_EQ(numbers->at("header.stamp.nanosec"), 5.0);
  EXPECT_EQ(numbers->at("x"), 0.5);
}

TEST(RosSchema, RefusesDefinitionsWithHoles) {
  EXPECT_FALSE(RosSchema::Parse("", "a/B"));
  EXPECT_FALSE(RosSchema::Parse("Unknown thing", "a/B"));
  EXPECT_FALSE(RosSchema::Parse("float64", "a/B"));
  EXPECT_FALSE(RosSchema::Parse("float64[x] y", "a/B"));
  EXPECT_FALSE(RosSchema::Parse("float64[99999999999] y", "a/B"));
}

TEST(RosSchema, EndsOnDefinitionsThatExplode) {
  const auto recursive = RosSchema::Parse("B next\n===\nMSG: a/B\nB next\n", "a/A");
  ASSERT_TRUE(recursive);
  EXPECT_FALSE(recursive->Read(std::vector<std::uint8_t>(100), RosEncoding::kRos1));
  const auto wide = RosSchema::Parse(
      "B[1000000] b\n===\nMSG: a/B\nC[1000000] c\n===\nMSG: a/C\nuint8 X=1\n", "a/A");
  ASSERT_TRUE(wide);
  EXPECT_FALSE(wide->Read(std::vector<std::uint8_t>(100), RosEncoding::kRos1));
}

TEST(RosSchema, ManyMessagesAreLinkedInTimeThatIsProportional) {
  constexpr int kNum = 100'000;  // each looked for among all others took minutes
  std::string definition, messages;
  for (int i = 0; i < kNum; ++i) {
    definition += fmt::format("M{0} f{0}\n", i);
    messages += fmt::format("====\nMSG: a/M{}\nuint8 x\n", i);
  }
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_TRUE(RosSchema::Parse(definition + messages, "a/Top"));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

}  // namespace
}  // namespace lio
