// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/receiver.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "lio/io/cpu_clock.hpp"

namespace lio {
namespace {

class ReceiverTest : public ::testing::Test {
 protected:
  // Runs the receive thread over what was published, then stops it.
  void ReceiveAll() {
    std::thread thread([this] { receiver_.Run(); });
    receiver_.Stop();
    thread.join();
    inbox_.Close();
  }
  int NumItems() {
    int num_items = 0;
    while (inbox_.Take()) ++num_items;
    return num_items;
  }

  std::unique_ptr<Bus> bus_ = OpenMemoryBus();
  Channels channels_;
  FilterInbox inbox_;
  StatusBoard board_{"", 0};
  OtherDaemons others_{1};
  std::vector<std::string> refusals_;
  Receiver receiver_{*bus_,
                     channels_,
                     ThreadCpuNs,
                     inbox_,
                     board_,
                     others_,
                     [this](const Command& command, const std::string& why) {
                       refusals_.push_back(std::to_string(command.request_id) + ": " + why);
                     }};
};

TEST_F(ReceiverTest, WhatArrivedBeforeTheStopIsTaken) {
  for (int i = 0; i < 500; ++i) EXPECT_TRUE(bus_->Publish("LIO_IMU", EncodeImu({}, i)));
  EXPECT_TRUE(bus_->Publish("LIO_SCAN", EncodeChunk({})));
  ReceiveAll();
  EXPECT_EQ(NumItems(), 501);
}

TEST_F(ReceiverTest, GarbageIsCountedByReasonAndGoesNoFurther) {
  EXPECT_TRUE(bus_->Publish("LIO_IMU", Bytes(3)));
  EXPECT_TRUE(bus_->Publish("LIO_IMU", EncodeChunk({})));
  EXPECT_TRUE(bus_->Publish("LIO_SCAN", Bytes(100, 0xff)));
  EXPECT_TRUE(bus_->Publish("LIO_SCAN", Bytes(kMaxMessageBytes + 1)));
  ReceiveAll();
  EXPECT_EQ(NumItems(), 0);
  const auto& refused = board_.input().num_refused;
  EXPECT_EQ(refused[static_cast<std::size_t>(DecodeStatus::kTruncated)], 1);
  EXPECT_EQ(refused[static_cast<std::size_t>(DecodeStatus::kWrongType)], 2);
  EXPECT_EQ(refused[static_cast<std::size_t>(DecodeStatus::kTooLarge)], 1);
}

TEST_F(ReceiverTest, CommandsKeepTheirPlaceAndBadOnesAreCounted) {
  EXPECT_TRUE(bus_->Publish("LIO_IMU", EncodeImu({}, 0)));
  EXPECT_TRUE(bus_->Publish("LIO_CMD", EncodeCommand({.request_id = 5})));
  EXPECT_TRUE(bus_->Publish("LIO_IMU", EncodeImu({}, 1)));
  EXPECT_TRUE(bus_->Publish("LIO_CMD", Bytes(28)));
  ReceiveAll();
  EXPECT_TRUE(std::holds_alternative<Arrival<ImuSample>>(*inbox_.Take()));
  const auto request = inbox_.Take();
  ASSERT_TRUE(std::holds_alternative<Request>(*request));
  EXPECT_EQ(std::get<Request>(*request).command.request_id, 5);
  EXPECT_EQ(NumItems(), 1);
  EXPECT_TRUE(refusals_.empty());
  EXPECT_EQ(board_.Compose().num_commands_refused, 1);
}

TEST_F(ReceiverTest, ACommandThatCanBeAnsweredIsRefusedWithItsReason) {
  const auto unknown = static_cast<CommandAction>(99);
  EXPECT_TRUE(bus_->Publish("LIO_CMD", EncodeCommand({.request_id = 5, .action = unknown})));
  for (int i = 0; i < 65; ++i) {
    EXPECT_TRUE(bus_->Publish("LIO_CMD", EncodeCommand({.request_id = 100 + i})));
  }
  ReceiveAll();
  EXPECT_EQ(NumItems(), 64);
  ASSERT_EQ(refusals_.size(), 2u);
  EXPECT_EQ(refusals_[0], "5: no action is 99");
  EXPECT_EQ(refusals_[1], "164: too many commands wait already");
}

TEST_F(ReceiverTest, AClosedBusEndsIt) {
  const auto closed = OpenNullBus();
  Receiver receiver(*closed, channels_, ThreadCpuNs, inbox_, board_, others_,
                    [](const Command&, const std::string&) {});
  receiver.Run();
  EXPECT_TRUE(receiver.has_ended());
}

TEST_F(ReceiverTest, TheStatusOfAnotherDaemonIsHeard) {
  StatusReport report;
  for (const std::int64_t start_utime : {1, 1, 2, 2, 2}) {
    report.start_utime = start_utime;
    EXPECT_TRUE(bus_->Publish("LIO_STATUS", EncodeStatus(report, "1.2.3")));
  }
  EXPECT_TRUE(bus_->Publish("LIO_STATUS", Bytes(100, 0xff)));
  ReceiveAll();
  EXPECT_EQ(others_.heard().num, 2);
  EXPECT_EQ(others_.heard().start_utime, 2);
  EXPECT_EQ(board_.input().TotalRefused(), 0) << "it is no input of the estimator";
}

}  // namespace
}  // namespace lio
