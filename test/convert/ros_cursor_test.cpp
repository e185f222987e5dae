// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/ros_cursor.hpp"

#include <gtest/gtest.h>

#include "support/ros_bag.hpp"

namespace lio {
namespace {

using test::RosBytes;

RosBytes Mixed(RosEncoding encoding, bool big_endian = false) {
  RosBytes bytes(encoding, big_endian);
  bytes.Put(std::uint8_t{5}).Put(2.5).PutString("abc").Put(std::uint16_t{7}).Put(std::uint32_t{9});
  return bytes;
}

void ExpectMixed(RosCursor cursor) {
  EXPECT_EQ(cursor.Read<std::uint8_t>(), 5);
  EXPECT_EQ(cursor.Read<double>(), 2.5);
  EXPECT_EQ(cursor.ReadString(), "abc");
  EXPECT_EQ(cursor.Read<std::uint16_t>(), 7);
  EXPECT_EQ(cursor.Read<std::uint32_t>(), 9u);
  EXPECT_TRUE(cursor.AtEnd());
}

TEST(RosCursor, ReadsRos1WithoutPadding) {
  const RosBytes bytes = Mixed(RosEncoding::kRos1);
  EXPECT_EQ(bytes.bytes().size(), 1u + 8 + 4 + 3 + 2 + 4);
  ExpectMixed(RosCursor(bytes.bytes(), RosEncoding::kRos1));
}

TEST(RosCursor, ReadsCdrOfBothByteOrders) {
  for (const bool big_endian : {false, true}) {
    const RosBytes bytes = Mixed(RosEncoding::kCdr, big_endian);
    RosCursor cursor(bytes.bytes(), RosEncoding::kCdr);
    EXPECT_EQ(cursor.big_endian(), big_endian);
    ExpectMixed(cursor);
  }
}

TEST(RosCursor, RefusesCdrOfAnotherKind) {
  const std::vector<std::uint8_t> parameter_list = {0, 3, 0, 0, 1, 2, 3, 4};
  EXPECT_FALSE(RosCursor(parameter_list, RosEncoding::kCdr).ok());
  EXPECT_FALSE(RosCursor(ByteView(parameter_list).first(3), RosEncoding::kCdr).ok());
}

TEST(RosCursor, StaysFalseAfterReadingPastTheEnd) {
  const std::vector<std::uint8_t> bytes = {1, 2, 3, 4, 5};
  RosCursor cursor(bytes, RosEncoding::kRos1);
  EXPECT_EQ(cursor.Read<double>(), 0.0);
  EXPECT_FALSE(cursor.ok());
  EXPECT_EQ(cursor.Read<std::uint8_t>(), 0);
  EXPECT_FALSE(cursor.ok());
  EXPECT_FALSE(cursor.AtEnd());
}

TEST(RosCursor, RefusesCountsThatCannotFit) {
  RosBytes bytes;
  bytes.Put(std::uint32_t{0x20000000}).Put(1.0);
  RosCursor cursor(bytes.bytes(), RosEncoding::kRos1);
  EXPECT_EQ(cursor.ReadCount(8), 0u);
  EXPECT_FALSE(cursor.ok());
}

TEST(RosCursor, RefusesSkipsWhoseSizeOverflows) {
  const std::vector<std::uint8_t> bytes(64);
  RosCursor cursor(bytes, RosEncoding::kRos1);
  cursor.SkipValues(SIZE_MAX / 4, 8);
  EXPECT_FALSE(cursor.ok());
}

TEST(RosCursor, RefusesABillionNanoseconds) {
  RosBytes bytes;
  bytes.Put(std::uint32_t{5}).Put(std::uint32_t{1'000'000'000});
  RosCursor cursor(bytes.bytes(), RosEncoding::kRos1);
  cursor.ReadTime();
  EXPECT_FALSE(cursor.ok());
}

}  // namespace
}  // namespace lio
