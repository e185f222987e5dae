// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Limits that bags of all kinds have in common. A bag that exceeds them is damaged, or an attack.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lio {

inline constexpr std::size_t kMaxNameBytes = 255;               // ROS allows no longer names
inline constexpr std::uint32_t kMaxBagMessageBytes = 1u << 28;  // 256 MiB: no message is larger
// The sweeps of the largest lidars (1 M points of 48 bytes) fit; memory is five times as much.
inline constexpr std::uint32_t kMaxWantedBytes = 1u << 26;
// A recorder closes a chunk at some megabytes or after one message that is larger.
inline constexpr std::uint64_t kMaxChunkBytes = 1u << 29;
inline constexpr std::uint32_t kMaxDefinitionBytes = 1u << 24;  // definitions are some kilobytes
// This is the year 2106, the limit of ROS 1, too.
inline constexpr std::int64_t kMaxReceivedNs = 4'294'967'296'000'000'000;

}  // namespace lio
