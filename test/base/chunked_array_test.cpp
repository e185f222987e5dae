// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/chunked_array.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace lio {
namespace {

// Four of these fill a chunk.
struct Large {
  std::array<std::uint8_t, 16000> bytes{};
};

TEST(ChunkedArray, WhatItHoldsStaysWhereItIsAsItGrows) {
  ChunkedArray<Large> array;
  constexpr std::uint8_t kNum = 100;
  array.MakeRoomAt(0);
  const Large* first = &array[0];
  for (std::uint8_t i = 0; i < kNum; ++i) {
    array.MakeRoomAt(i);
    EXPECT_EQ(array[i].bytes[0], 0);
    array[i].bytes[0] = i;
  }
  EXPECT_EQ(&array[0], first);
  for (std::uint8_t i = 0; i < kNum; ++i) EXPECT_EQ(array[i].bytes[0], i);
}

TEST(ChunkedArray, KeepsLittleMoreMemoryThanItUses) {
  ChunkedArray<Large> array;
  EXPECT_EQ(array.memory_bytes(), 0u);
  for (std::size_t i = 0; i < 9; ++i) array.MakeRoomAt(i);
  EXPECT_GE(array.memory_bytes(), 9 * sizeof(Large));
  EXPECT_LT(array.memory_bytes(), 13 * sizeof(Large));
}

TEST(ChunkedArray, MakingRoomTwiceChangesNothing) {
  ChunkedArray<int> array;
  array.MakeRoomAt(0);
  array[0] = 5;
  array.MakeRoomAt(0);
  EXPECT_EQ(array[0], 5);
}

}  // namespace
}  // namespace lio
