// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lio/command_t.hpp"
#include "lio/io/command.hpp"
#include "lio/reply_t.hpp"

namespace lio {
namespace {

Command Full() {
  Command command;
  command.request_id = 42;
  command.action = CommandAction::kResetAtPose;
  command.T_world_imu = {Quaternion(0.5, -0.5, 0.5, -0.5), {1.0, 2.0, 3.0}};
  Matrix6 cov;
  for (int i = 0; i < 36; ++i) cov(i / 6, i % 6) = i;
  command.pose_cov = cov;
  command.name = "map.ply";
  return command;
}

TEST(CommandCodec, CommandsRoundTripAndAgreeWithTheGeneratedType) {
  const Bytes bytes = EncodeCommand(Full());
  Command command;
  ASSERT_EQ(DecodeCommand(bytes, command), DecodeStatus::kOk);
  EXPECT_EQ(command.request_id, 42);
  EXPECT_EQ(command.action, CommandAction::kResetAtPose);
  EXPECT_EQ(command.T_world_imu.translation, Full().T_world_imu.translation);
  EXPECT_EQ(command.T_world_imu.rotation.coeffs(), Full().T_world_imu.rotation.coeffs());
  EXPECT_EQ(*command.pose_cov, *Full().pose_cov);
  EXPECT_EQ(command.name, "map.ply");
  command_t message;
  ASSERT_EQ(message.decode(bytes.data(), 0, static_cast<int>(bytes.size())),
            static_cast<int>(bytes.size()));
  EXPECT_EQ(message.action, command_t::RESET_AT_POSE);
  EXPECT_EQ(message.quat[1], -0.5);
  EXPECT_EQ(message.pose_cov[1][0], 6.0);
  ASSERT_EQ(DecodeCommand(EncodeCommand({.request_id = 7}), command), DecodeStatus::kOk);
  EXPECT_FALSE(command.pose_cov) << "nothing of the last one stays";
  EXPECT_EQ(command.name, "");
}

TEST(CommandCodec, TheActionsHaveTheNumbersOfTheType) {
  EXPECT_EQ(static_cast<int>(CommandAction::kCloudFullOff), command_t::CLOUD_FULL_OFF);
  EXPECT_EQ(static_cast<int>(CommandAction::kCloudFullOn), command_t::CLOUD_FULL_ON);
  EXPECT_EQ(static_cast<int>(CommandAction::kReset), command_t::RESET);
  EXPECT_EQ(static_cast<int>(CommandAction::kSaveMap), command_t::SAVE_MAP);
  EXPECT_EQ(static_cast<int>(CommandAction::kNewFiles), command_t::NEW_FILES);
  EXPECT_EQ(static_cast<int>(CommandAction::kStatusNow), command_t::STATUS_NOW);
  EXPECT_EQ(kNumCommandActions, command_t::STATUS_NOW + 1);
}

TEST(CommandCodec, TruncatedLongerForeignAndUnknownCommandsAreRefused) {
  Bytes bytes = EncodeCommand(Full());
  Command command;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_EQ(DecodeCommand({bytes.data(), size}, command), DecodeStatus::kTruncated);
  }
  bytes.push_back(0);
  EXPECT_EQ(DecodeCommand(bytes, command), DecodeStatus::kSizeMismatch);
  bytes.pop_back();
  bytes[27] = 99;
  command.request_id = 0;
  EXPECT_EQ(DecodeCommand(bytes, command), DecodeStatus::kBadFormat);
  EXPECT_EQ(command.request_id, 42) << "so that it can be answered";
  EXPECT_EQ(static_cast<int>(command.action), 99);
  bytes[0] ^= 1;
  EXPECT_EQ(DecodeCommand(bytes, command), DecodeStatus::kWrongType);
}

TEST(CommandCodec, NoLengthOfANameReadsBeyondTheMessage) {
  Bytes bytes = EncodeCommand({.request_id = 1});
  const std::size_t at = bytes.size() - 5;
  for (const int first : {0x00, 0x7f, 0x80, 0xff}) {
    for (const int last : {0x00, 0x02, 0xff}) {
      bytes[at] = static_cast<std::uint8_t>(first);
      bytes[at + 3] = static_cast<std::uint8_t>(last);
      Command command;
      EXPECT_NE(DecodeCommand(bytes, command), DecodeStatus::kOk) << first << " " << last;
    }
  }
  Command longest{.request_id = 1, .name = std::string(kMaxCommandName, 'a')};
  EXPECT_EQ(DecodeCommand(EncodeCommand(longest), longest), DecodeStatus::kOk);
  longest.name += 'a';
  EXPECT_EQ(DecodeCommand(EncodeCommand(longest), longest), DecodeStatus::kBadFormat);
}

TEST(CommandCodec, RepliesAgreeWithTheGeneratedType) {
  const Bytes bytes =
      EncodeReply({.utime = 5, .request_id = 9, .action = 2, .is_done = false, .text = "not now"});
  reply_t message;
  ASSERT_GT(message.decode(bytes.data(), 0, static_cast<int>(bytes.size())), 0);
  EXPECT_EQ(message.utime, 5);
  EXPECT_EQ(message.request_id, 9);
  EXPECT_EQ(message.action, 2);
  EXPECT_EQ(message.result, reply_t::REFUSED);
  EXPECT_EQ(message.text, "not now");
}

}  // namespace
}  // namespace lio
