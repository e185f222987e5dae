// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Messages to domain types and back: with its source and status_codec.cpp the only place that sees
// generated LCM types. Decoding checks hash, counts and sizes before it trusts a byte (shared
// rules: docs/messages.md) and never throws.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "lio/pipeline/outputs.hpp"
#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/scan_chunk.hpp"

namespace lio {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

enum class DecodeStatus : std::uint8_t {
  kOk = 0,
  kTruncated,     // shorter than its fixed part
  kWrongType,     // another fingerprint
  kSizeMismatch,  // its counts and its size disagree
  kBadFormat,     // unknown point format or step, or a stamp outside 1970..2116
  kTooLarge,      // above kMaxMessageBytes
};
inline constexpr int kNumDecodeStatuses = 6;
std::string_view Name(DecodeStatus status);

inline constexpr std::size_t kMaxMessageBytes = 8u << 20;

// The messages' fingerprints: the first eight bytes of each, big-endian, and the only version there
// is. A released type is never edited, so these never change (a test compares them).
inline constexpr std::uint64_t kImuFingerprint = 0x4116ba332106780e;
inline constexpr std::uint64_t kScanFingerprint = 0x8a84c8aeb5c1b9ef;

// On anything but kOk the outputs are left as they were or half filled; do not use them. Values are
// not judged here: samples may be NaN, chunks inconsistent.
DecodeStatus DecodeImu(ByteView bytes, ImuSample& sample, std::int32_t& seq);
DecodeStatus DecodeChunk(ByteView bytes, ScanChunk& chunk);  // reuses chunk.points' memory

Bytes EncodeImu(const ImuSample& sample, std::int32_t seq);
// The stamp is truncated to whole microseconds and the points' offsets are moved to match.
Bytes EncodeChunk(const ScanChunk& chunk);
Bytes EncodeOdometry(const NavOutput& nav);
Bytes EncodeLocalOdometry(const FilterReport& report);  // the same fields, of the pose in map
Bytes EncodeBaseOdometry(const NavOutput& nav);         // needs nav.base
Bytes EncodeFilterState(const FilterReport& report);
Bytes EncodeRegistration(const ScanReport& report);
Bytes EncodeCloud(const RegisteredCloud& cloud);

}  // namespace lio
