// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/sweep_to_chunks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace lio {
namespace {

constexpr std::int64_t kSweepBegin_ns = 1'500'000'000'000'000'123;

// Returns `num` points 10 us apart in a shuffled order; a point's x gives its place in time.
TimedSweep ShuffledSweep(std::size_t num) {
  std::vector<std::size_t> order(num);
  for (std::size_t i = 0; i < num; ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  std::vector<LidarPoint> points(num);
  std::vector<std::int64_t> instants(num);
  for (std::size_t i = 0; i < num; ++i) {
    points[i].x_m = static_cast<float>(order[i]);
    instants[i] = kSweepBegin_ns + static_cast<std::int64_t>(order[i]) * 10'000;
  }
  return SortSweep(std::move(points), instants);
}

TEST(SortSweep, OrdersPointsByTime) {
  const TimedSweep sweep = ShuffledSweep(1000);
  EXPECT_EQ(sweep.first.ns, kSweepBegin_ns);
  EXPECT_EQ(sweep.last.ns, kSweepBegin_ns + 9'990'000);
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    EXPECT_EQ(sweep.points[i].x_m, static_cast<float>(i));
    EXPECT_EQ(sweep.points[i].t_offset_ns, i * 10'000);
  }
}

TEST(SortSweep, KeepsTheOrderOfEqualTimes) {
  std::vector<LidarPoint> points(300);
  std::vector<std::int64_t> instants(300);
  for (std::size_t i = 0; i < 300; ++i) {
    points[i].x_m = static_cast<float>(i);
    instants[i] = kSweepBegin_ns - static_cast<std::int64_t>(i / 100);
  }
  const TimedSweep sweep = SortSweep(points, instants);
  for (std::size_t i = 1; i < 300; ++i) {
    const auto& a = sweep.points[i - 1];
    const auto& b = sweep.points[i];
    EXPECT_TRUE(a.t_offset_ns < b.t_offset_ns || a.x_m < b.x_m);
  }
}

TEST(SortSweep, OfNothingIsEmpty) {
  EXPECT_TRUE(SortSweep({}, {}).points.empty());
  EXPECT_TRUE(SplitSweep(TimedSweep(), 0, Timestamp{}).empty());
}

TEST(SplitSweep, GivesChunksOfADatagramWithTheirOwnStamps) {
  const TimedSweep sweep = ShuffledSweep(7000);
  const Timestamp received{kSweepBegin_ns + 200'000'000};
  const auto sent = SplitSweep(sweep, 42, received);
  ASSERT_EQ(sent.size(), 3u);
  std::size_t next = 0;
  for (std::size_t k = 0; k < sent.size(); ++k) {
    const ScanChunk& chunk = sent[k].chunk;
    EXPECT_LE(chunk.points.size(), 3072u);
    EXPECT_EQ(chunk.scan_seq, 42);
    EXPECT_EQ(chunk.chunk_index, static_cast<int>(k));
    EXPECT_EQ(chunk.chunk_count, 3);
    EXPECT_EQ(chunk.points.front().t_offset_ns, 0u);
    for (const LidarPoint& point : chunk.points) {
      EXPECT_EQ(point.x_m, static_cast<float>(next));
      EXPECT_EQ(chunk.stamp.ns + point.t_offset_ns,
                kSweepBegin_ns + static_cast<std::int64_t>(next) * 10'000);
      ++next;
    }
    // Each chunk is sent as long before the cloud's reception as its last point was before the
    // sweep's end.
    const std::int64_t last = chunk.stamp.ns + chunk.points.back().t_offset_ns;
    EXPECT_EQ((received - sent[k].sent).ns, sweep.last.ns - last);
  }
  EXPECT_EQ(next, 7000u);
  EXPECT_EQ(sent.back().sent, received);
}

TEST(SplitSweep, GivesOneChunkWhenAllowed) {
  const auto sent = SplitSweep(ShuffledSweep(7000), 1, Timestamp{kSweepBegin_ns}, 7000);
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].chunk.points.size(), 7000u);
  EXPECT_EQ(sent[0].chunk.chunk_count, 1);
}

TEST(QuantiseIntensity, RoundsAndClamps) {
  EXPECT_EQ(QuantiseIntensity(12.6f), 13);
  EXPECT_EQ(QuantiseIntensity(-3.0f), 0);
  EXPECT_EQ(QuantiseIntensity(1e9f), 65535);
  EXPECT_EQ(QuantiseIntensity(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(QuantiseIntensity(std::numeric_limits<float>::infinity()), 65535);
}

}  // namespace
}  // namespace lio
