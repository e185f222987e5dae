// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/byte_order.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

constexpr std::uint8_t kBytes[] = {0xEE, 0x01, 0x02, 0x03, 0x84, 0x00, 0x00, 0xC0, 0x3F};

TEST(ByteOrder, NumbersAreReadInEitherOrder) {
  EXPECT_EQ(LoadAs<std::uint16_t>(kBytes + 1), 0x0201);
  EXPECT_EQ(LoadAs<std::uint16_t>(kBytes + 1, true), 0x0102);
  EXPECT_EQ(LoadAs<std::uint32_t>(kBytes + 1), 0x84030201u);
  EXPECT_EQ(LoadAs<std::uint32_t>(kBytes + 1, true), 0x01020384u);
}

TEST(ByteOrder, SignsAndFractionsAreKept) {
  EXPECT_EQ(LoadAs<std::int8_t>(kBytes + 4), -124);
  EXPECT_EQ(LoadAs<std::int32_t>(kBytes + 1), static_cast<std::int32_t>(0x84030201u));
  EXPECT_EQ(LoadAs<float>(kBytes + 5), 1.5f);  // 0x3FC00000
  const std::uint8_t reversed[] = {0x3F, 0xC0, 0x00, 0x00};
  EXPECT_EQ(LoadAs<float>(reversed, true), 1.5f);
}

// Any byte but zero is true; a bool of value 2 would be undefined behaviour.
TEST(ByteOrder, AnyByteButZeroIsTrue) {
  EXPECT_TRUE(LoadAs<bool>(kBytes + 2));
  EXPECT_FALSE(LoadAs<bool>(kBytes + 5));
}

}  // namespace
}  // namespace lio
