// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests every bus that delivers with one suite. LCM's in-process transport stands for LCM here;
// lcm_bus_test.cpp and memory_bus_test.cpp test what is particular to one of them.
#include "lio/io/bus.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lio {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;

struct BusKind {
  const char* name;
  std::unique_ptr<Bus> (*open)();
};

class BusTest : public ::testing::TestWithParam<BusKind> {
 protected:
  void Drain() {
    while (bus_->Receive(milliseconds(20)) == ReceiveResult::kMessage) {
    }
  }
  Bus::Handler Recorder(std::vector<Bytes>& messages) {
    return [&messages](ByteView data, std::int64_t) {
      messages.emplace_back(data.begin(), data.end());
    };
  }

  std::unique_ptr<Bus> bus_ = GetParam().open();
};

TEST_P(BusTest, MessagesReachTheirChannelInOrder) {
  std::vector<Bytes> imu;
  std::vector<Bytes> scan;
  bus_->Subscribe("LIO_IMU", 10, Recorder(imu));
  bus_->Subscribe("LIO_SCAN", 10, Recorder(scan));
  EXPECT_TRUE(bus_->Publish("LIO_IMU", Bytes{1}));
  EXPECT_TRUE(bus_->Publish("LIO_SCAN", Bytes{2}));
  EXPECT_TRUE(bus_->Publish("LIO_IMU", Bytes{3}));
  EXPECT_TRUE(bus_->Publish("LIO_OTHER", Bytes{4}));
  Drain();
  EXPECT_THAT(imu, ElementsAre(Bytes{1}, Bytes{3}));
  EXPECT_THAT(scan, ElementsAre(Bytes{2}));
}

TEST_P(BusTest, ChannelNamesAreNoExpressions) {
  std::vector<Bytes> messages;
  bus_->Subscribe("a.IMU", 10, Recorder(messages));
  EXPECT_TRUE(bus_->Publish("axIMU", Bytes{1}));
  EXPECT_TRUE(bus_->Publish("a.IMU", Bytes{2}));
  Drain();
  EXPECT_THAT(messages, ElementsAre(Bytes{2}));
}

TEST_P(BusTest, WaitingEndsWithoutMessages) {
  bus_->Subscribe("LIO_IMU", 10, [](ByteView, std::int64_t) {});
  EXPECT_EQ(bus_->Receive(milliseconds(1)), ReceiveResult::kTimeout);
}

TEST_P(BusTest, WhatAHandlerThrowsIsCountedAndDeliveryGoesOn) {
  int num_calls = 0;
  bus_->Subscribe("LIO_IMU", 10, [&](ByteView, std::int64_t) {
    if (++num_calls == 1) throw std::length_error("bad count");
  });
  EXPECT_TRUE(bus_->Publish("LIO_IMU", Bytes{1}));
  EXPECT_TRUE(bus_->Publish("LIO_IMU", Bytes{2}));
  Drain();
  EXPECT_EQ(num_calls, 2);
  EXPECT_EQ(bus_->num_handler_faults(), 1);
}

TEST_P(BusTest, OversizedMessagesAreCountedAndNotDelivered) {
  int num_calls = 0;
  bus_->Subscribe("LIO_SCAN", 10, [&](ByteView, std::int64_t) { ++num_calls; });
  EXPECT_TRUE(bus_->Publish("LIO_SCAN", Bytes(kMaxMessageBytes + 1)));
  EXPECT_TRUE(bus_->Publish("LIO_SCAN", Bytes(kMaxMessageBytes)));
  Drain();
  EXPECT_EQ(num_calls, 1);
  EXPECT_EQ(bus_->num_oversized(), 1);
}

TEST_P(BusTest, ArrivalTimesAreTheHostsClock) {
  std::int64_t arrival = 0;
  bus_->Subscribe("LIO_IMU", 10, [&](ByteView, std::int64_t utime) { arrival = utime; });
  const auto before = std::chrono::system_clock::now().time_since_epoch();
  EXPECT_TRUE(bus_->Publish("LIO_IMU", Bytes{1}));
  Drain();
  EXPECT_GE(arrival, std::chrono::duration_cast<std::chrono::microseconds>(before).count());
  EXPECT_LT(arrival,
            std::chrono::duration_cast<std::chrono::microseconds>(before).count() + 60'000'000);
}

INSTANTIATE_TEST_SUITE_P(Buses, BusTest,
                         ::testing::Values(BusKind{"Memory", [] { return OpenMemoryBus(); }},
                                           BusKind{"Lcm", [] { return OpenLcmBus("memq://"); }}),
                         [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace lio
