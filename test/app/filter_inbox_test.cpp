// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/filter_inbox.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

namespace lio {
namespace {

using ::testing::ElementsAre;

Arrival<ImuSample> Imu(std::int64_t stamp_ns) {
  return {{.stamp = Timestamp{stamp_ns}}, 0, 0};
}

Arrival<ScanChunk> Chunk(std::int32_t scan_seq, std::size_t num_points) {
  Arrival<ScanChunk> arrival;
  arrival.data.scan_seq = scan_seq;
  arrival.data.points.resize(num_points);
  return arrival;
}

// Empties a closed inbox: returns stamps of samples, and 1000 plus the sequence numbers of chunks.
std::vector<std::int64_t> Contents(FilterInbox& inbox) {
  std::vector<std::int64_t> contents;
  while (const auto item = inbox.Take()) {
    if (const auto* imu = std::get_if<Arrival<ImuSample>>(item.get())) {
      contents.push_back(imu->data.stamp.ns);
    } else {
      contents.push_back(1000 + std::get<Arrival<ScanChunk>>(*item).data.scan_seq);
    }
  }
  return contents;
}

TEST(FilterInbox, ChunksWithoutPointsAreBoundedToo) {
  FilterInbox inbox;
  constexpr int kNum = 70'000;
  for (int i = 0; i < kNum; ++i) inbox.Put(Chunk(i, 0));
  EXPECT_EQ(inbox.losses().num_chunks, kNum - (1 << 16));
  inbox.Close();
  EXPECT_EQ(Contents(inbox).size(), std::size_t{1 << 16});
}

TEST(FilterInbox, MessagesComeOutAsTheyArrived) {
  FilterInbox inbox;
  inbox.Put(Imu(1));
  inbox.Put(Chunk(0, 5));
  inbox.Put(Imu(2));
  inbox.Close();
  EXPECT_THAT(Contents(inbox), ElementsAre(1, 1000, 2));
}

TEST(FilterInbox, OutcomesComeFirst) {
  FilterInbox inbox;
  inbox.Put(Imu(1));
  inbox.Put(MatchOutcome{});
  EXPECT_TRUE(std::holds_alternative<MatchOutcome>(*inbox.Take()));
  EXPECT_TRUE(std::holds_alternative<Arrival<ImuSample>>(*inbox.Take()));
}

TEST(FilterInbox, TakingTheOutcomeLeavesMessages) {
  FilterInbox inbox;
  inbox.Put(Imu(1));
  MatchOutcome outcome;
  outcome.num_used = 7;
  std::thread matcher([&] { inbox.Put(outcome); });
  EXPECT_EQ(inbox.TakeOutcome().value().num_used, 7);
  matcher.join();
  inbox.Close();
  EXPECT_THAT(Contents(inbox), ElementsAre(1));
}

TEST(FilterInbox, TooManyPointsDropAllChunksOfTheOldestScanAndNoSample) {
  FilterInbox inbox(10, 100);
  inbox.Put(Chunk(1, 40));
  inbox.Put(Imu(1));
  inbox.Put(Chunk(1, 40));
  inbox.Put(Chunk(2, 10));
  inbox.Put(Imu(2));
  inbox.Put(Chunk(2, 20));
  inbox.Close();
  EXPECT_EQ(inbox.losses().num_chunks, 2);
  EXPECT_EQ(inbox.losses().num_imu, 0);
  EXPECT_THAT(Contents(inbox), ElementsAre(1, 1002, 2, 1002));
}

TEST(FilterInbox, AScanLargerThanTheLimitIsDroppedToo) {
  FilterInbox inbox(10, 100);
  inbox.Put(Chunk(1, 101));
  inbox.Put(Chunk(2, 100));
  inbox.Close();
  EXPECT_EQ(inbox.losses().num_chunks, 1);
  EXPECT_THAT(Contents(inbox), ElementsAre(1002));
}

TEST(FilterInbox, RoomFreedByTakingIsUsedAgain) {
  FilterInbox inbox(1, 100);
  for (int i = 0; i < 5; ++i) {
    inbox.Put(Chunk(i, 100));
    inbox.Put(Imu(i));
    EXPECT_TRUE(inbox.Take());
    EXPECT_TRUE(inbox.Take());
  }
  EXPECT_EQ(inbox.losses().num_chunks, 0);
  EXPECT_EQ(inbox.losses().num_imu, 0);
}

TEST(FilterInbox, SamplesBeyondTheLimitAreRefusedAndCounted) {
  FilterInbox inbox(2, 100);
  for (int i = 1; i <= 5; ++i) inbox.Put(Imu(i));
  inbox.Close();
  EXPECT_EQ(inbox.losses().num_imu, 3);
  EXPECT_THAT(Contents(inbox), ElementsAre(1, 2));
}

TEST(FilterInbox, WhenNoOutcomeWillComeTheWaitForItEnds) {
  FilterInbox inbox;
  MatchOutcome outcome;
  outcome.num_used = 7;
  inbox.Put(std::move(outcome));
  inbox.EndOutcomes();
  EXPECT_EQ(inbox.TakeOutcome().value().num_used, 7) << "it had come before";
  EXPECT_FALSE(inbox.TakeOutcome().has_value());
}

}  // namespace
}  // namespace lio
