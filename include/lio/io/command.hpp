// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Defines the commands that the daemon takes on LIO_CMD, and its replies on LIO_REPLY.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "lio/io/lcm_codec.hpp"

namespace lio {

enum class CommandAction : std::int32_t {
  kCloudFullOff,
  kCloudFullOn,
  kReset,
  kResetAtPose,
  kSaveMap,
  kNewFiles,
  kStatusNow,
};
inline constexpr int kNumCommandActions = 7;

struct Command {
  std::int64_t request_id = 0;
  CommandAction action = CommandAction::kCloudFullOff;
  // kResetAtPose: numbers as they came, finite or not; the rotation is not normalized.
  Pose T_world_imu = {};
  std::optional<Matrix6> pose_cov =
      std::nullopt;       // [position in world (m); right rotation error (rad)]
  std::string name = {};  // kSaveMap: as it came
};

struct Reply {
  std::int64_t utime = 0;  // us since the epoch, host's clock
  std::int64_t request_id = 0;
  std::int32_t action = 0;
  bool is_done = false;
  std::string text;  // one sentence
};

inline constexpr std::size_t kMaxCommandName = 255;  // bytes

// After kBadFormat (no such action, a name that is too long) the request_id and the action are
// known, so that it can be answered.
[[nodiscard]] DecodeStatus DecodeCommand(ByteView bytes, Command& command);
[[nodiscard]] Bytes EncodeCommand(const Command& command);
[[nodiscard]] Bytes EncodeReply(const Reply& reply);

}  // namespace lio
