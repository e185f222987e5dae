// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// One suite over every bus that delivers. LCM's in-process transport stands for LCM here; its
// multicast is tested with the daemon (test/integration).
#include "lio/io/bus.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

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
  bus_->Publish("axIMU", Bytes{1});
  bus_->Publish("a.IMU", Bytes{2});
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
  bus_->Publish("LIO_IMU", Bytes{1});
  bus_->Publish("LIO_IMU", Bytes{2});
  Drain();
  EXPECT_EQ(num_calls, 2);
  EXPECT_EQ(bus_->num_handler_faults(), 1);
}

TEST_P(BusTest, OversizedMessagesAreCountedAndNotDelivered) {
  int num_calls = 0;
  bus_->Subscribe("LIO_SCAN", 10, [&](ByteView, std::int64_t) { ++num_calls; });
  bus_->Publish("LIO_SCAN", Bytes(kMaxMessageBytes + 1));
  bus_->Publish("LIO_SCAN", Bytes(kMaxMessageBytes));
  Drain();
  EXPECT_EQ(num_calls, 1);
  EXPECT_EQ(bus_->num_oversized(), 1);
}

TEST_P(BusTest, ArrivalTimesAreTheHostsClock) {
  std::int64_t arrival = 0;
  bus_->Subscribe("LIO_IMU", 10, [&](ByteView, std::int64_t utime) { arrival = utime; });
  const auto before = std::chrono::system_clock::now().time_since_epoch();
  bus_->Publish("LIO_IMU", Bytes{1});
  Drain();
  EXPECT_GE(arrival, std::chrono::duration_cast<std::chrono::microseconds>(before).count());
  EXPECT_LT(arrival,
            std::chrono::duration_cast<std::chrono::microseconds>(before).count() + 60'000'000);
}

INSTANTIATE_TEST_SUITE_P(Buses, BusTest,
                         ::testing::Values(BusKind{"Memory", [] { return OpenMemoryBus(); }},
                                           BusKind{"Lcm", [] { return OpenLcmBus("memq://"); }}),
                         [](const auto& kind) { return kind.param.name; });

TEST(MemoryBus, AFullQueueLosesTheNewestMessageAsLcmDoes) {
  const auto bus = OpenMemoryBus();
  std::vector<std::uint8_t> heads;
  bus->Subscribe("LIO_IMU", 2, [&](ByteView data, std::int64_t) { heads.push_back(data[0]); });
  for (const std::uint8_t head : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}}) {
    bus->Publish("LIO_IMU", Bytes{head});
  }
  while (bus->Receive(milliseconds(0)) == ReceiveResult::kMessage) {
  }
  EXPECT_THAT(heads, ElementsAre(1, 2));
}

TEST(NullBus, TakesEverythingAndDeliversNothing) {
  const auto bus = OpenNullBus();
  bus->Subscribe("LIO_IMU", 2, [](ByteView, std::int64_t) { FAIL(); });
  EXPECT_TRUE(bus->Publish("LIO_IMU", Bytes{1}));
  EXPECT_EQ(bus->Receive(milliseconds(0)), ReceiveResult::kClosed);
}

TEST(LcmBus, AnUnusableUrlSaysWhatAUrlIs) {
  try {
    OpenLcmBus("nonsense://somewhere");
    FAIL();
  } catch (const TransportError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("nonsense://somewhere"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("give a URL of udpm://"));
  }
}

TEST(LcmBus, AMissingServerIsNamed) {
  try {
    OpenLcmBus("tcpq://127.0.0.1:1");  // nobody listens there
    FAIL();
  } catch (const TransportError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("TCPService"));
  }
}

TEST(LcmBus, PortComesFromTheUrlOrTheEnvironmentOrTheDefault) {
  EXPECT_EQ(UdpPort("udpm://239.255.76.67:7700?ttl=1"), 7700);
  EXPECT_EQ(UdpPort("udpm://239.255.76.67"), 7667);
  EXPECT_EQ(UdpPort("udpm://"), 7667);
  EXPECT_EQ(UdpPort("memq://"), 0);
  ::setenv("LCM_DEFAULT_URL", "udpm://239.255.76.67:7701", 1);
  EXPECT_EQ(UdpPort(""), 7701);
  ::unsetenv("LCM_DEFAULT_URL");
  EXPECT_EQ(UdpPort(""), 7667);
}

}  // namespace
}  // namespace lio
