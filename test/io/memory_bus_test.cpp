// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests what is particular to the buses without a transport; bus_test.cpp tests what all buses do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "lio/io/bus.hpp"

namespace lio {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;

void Drain(Bus& bus) {
  while (bus.Receive(milliseconds(0)) == ReceiveResult::kMessage) {
  }
}

TEST(MemoryBus, AFullQueueLosesTheNewestMessageAsLcmDoes) {
  const auto bus = OpenMemoryBus();
  std::vector<std::uint8_t> heads;
  bus->Subscribe("LIO_IMU", 2, [&](ByteView data, std::int64_t) { heads.push_back(data[0]); });
  for (std::uint8_t head = 1; head <= 3; ++head) EXPECT_TRUE(bus->Publish("LIO_IMU", Bytes{head}));
  Drain(*bus);
  EXPECT_THAT(heads, ElementsAre(1, 2));
  // There is room again.
  EXPECT_TRUE(bus->Publish("LIO_IMU", Bytes{4}));
  Drain(*bus);
  EXPECT_THAT(heads, ElementsAre(1, 2, 4));
}

TEST(MemoryBus, QueuesOfDifferentSubscribersFillOnTheirOwn) {
  const auto bus = OpenMemoryBus();
  int num_narrow = 0, num_wide = 0;
  bus->Subscribe("LIO_IMU", 1, [&](ByteView, std::int64_t) { ++num_narrow; });
  bus->Subscribe("LIO_IMU", 5, [&](ByteView, std::int64_t) { ++num_wide; });
  for (int i = 0; i < 7; ++i) EXPECT_TRUE(bus->Publish("LIO_IMU", Bytes{1}));
  Drain(*bus);
  EXPECT_EQ(num_narrow, 1);
  EXPECT_EQ(num_wide, 5);
}

TEST(MemoryBus, HandlersMayPublish) {
  const auto bus = OpenMemoryBus();
  std::vector<std::uint8_t> heads;
  bus->Subscribe("LIO_CMD", 5,
                 [&](ByteView data, std::int64_t) { EXPECT_TRUE(bus->Publish("LIO_ACK", data)); });
  bus->Subscribe("LIO_ACK", 5, [&](ByteView data, std::int64_t) { heads.push_back(data[0]); });
  EXPECT_TRUE(bus->Publish("LIO_CMD", Bytes{7}));
  Drain(*bus);
  EXPECT_THAT(heads, ElementsAre(7));
}

TEST(MemoryBus, AWaitingReceiverIsWokenByAnotherThread) {
  const auto bus = OpenMemoryBus();
  std::atomic<int> num_calls = 0;
  bus->Subscribe("LIO_IMU", 1, [&](ByteView, std::int64_t) { ++num_calls; });
  std::thread publisher([&] { EXPECT_TRUE(bus->Publish("LIO_IMU", Bytes{1})); });
  EXPECT_EQ(bus->Receive(std::chrono::seconds(30)), ReceiveResult::kMessage);
  publisher.join();
  EXPECT_EQ(num_calls, 1);
}

TEST(NullBus, TakesEverythingAndDeliversNothing) {
  const auto bus = OpenNullBus();
  bus->Subscribe("LIO_IMU", 2, [](ByteView, std::int64_t) { FAIL(); });
  EXPECT_TRUE(bus->Publish("LIO_IMU", Bytes{1}));
  EXPECT_TRUE(bus->Publish("LIO_IMU", Bytes(kMaxMessageBytes + 1)));
  EXPECT_EQ(bus->Receive(milliseconds(0)), ReceiveResult::kClosed);
  EXPECT_EQ(bus->num_oversized(), 0);
  EXPECT_EQ(bus->num_handler_faults(), 0);
}

}  // namespace
}  // namespace lio
