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
  StatusBoard board_{0, 0};
  std::vector<Command> commands_;
  Receiver receiver_{*bus_,  channels_, ThreadCpuNs,
                     inbox_, board_,    [this](const Command& c) { commands_.push_back(c); }};
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

TEST_F(ReceiverTest, CommandsAreObeyedAndBadOnesCounted) {
  EXPECT_TRUE(bus_->Publish("LIO_CMD", EncodeCommand({5, CommandAction::kCloudFullOn})));
  EXPECT_TRUE(bus_->Publish("LIO_CMD", Bytes(28)));
  ReceiveAll();
  ASSERT_EQ(commands_.size(), 1u);
  EXPECT_EQ(commands_[0].request_id, 5);
  EXPECT_EQ(board_.Compose().num_commands_refused, 1);
}

TEST_F(ReceiverTest, AClosedBusEndsIt) {
  const auto closed = OpenNullBus();
  Receiver receiver(*closed, channels_, ThreadCpuNs, inbox_, board_, [](const Command&) {});
  receiver.Run();
  EXPECT_TRUE(receiver.has_ended());
}

}  // namespace
}  // namespace lio
