// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "io/queue_capacity.hpp"

#include <gtest/gtest.h>

namespace lio {
namespace {

constexpr std::size_t kChunkBytes = 61'440;

TEST(QueueCapacity, ChunksOfADatagramMayWaitAsManyAsTheyAre) {
  QueueCapacity capacity(1024);
  EXPECT_EQ(capacity.now(), 1024);
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(capacity.Take(kChunkBytes + 100));
  EXPECT_FALSE(capacity.Take(0));
  EXPECT_EQ(capacity.now(), 1024);
}

TEST(QueueCapacity, OfLargeMessagesFewerMayWait) {
  QueueCapacity capacity(1024);
  EXPECT_TRUE(capacity.Take(2 << 20));
  EXPECT_EQ(capacity.now(), 32);
  EXPECT_FALSE(capacity.Take(2 << 20));
  EXPECT_TRUE(capacity.Take(8 << 20));
  EXPECT_EQ(capacity.now(), 8);
  EXPECT_LE(static_cast<std::size_t>(capacity.now()) * (8 << 20), QueueCapacity::kMaxBytes);
}

TEST(QueueCapacity, ALargeMessageIsForgotten) {
  QueueCapacity capacity(1024);
  EXPECT_TRUE(capacity.Take(8 << 20));
  int num_small = 0;
  for (; capacity.now() < 1024 && num_small < 1000; ++num_small) (void)capacity.Take(kChunkBytes);
  EXPECT_LT(num_small, 60);
}

TEST(QueueCapacity, AShortQueueStaysShort) {
  QueueCapacity capacity(3);
  EXPECT_FALSE(capacity.Take(100 << 20));
  EXPECT_EQ(capacity.now(), 3);
}

}  // namespace
}  // namespace lio
