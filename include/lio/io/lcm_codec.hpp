// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Converts LCM messages to the estimator's types and back. Only the sources of this header and of
// status_report.hpp see the generated LCM types. Decoding checks fingerprint, counts and sizes
// before it uses a byte (the rules are in docs/messages.md) and never throws.
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

enum class [[nodiscard]] DecodeStatus : std::uint8_t{
    kOk = 0,
    kTruncated,     // shorter than its fixed part
    kWrongType,     // another fingerprint
    kSizeMismatch,  // its counts and its size disagree
    kBadFormat,     // unknown point format or step, or a stamp outside 1970..2116
    kTooLarge,      // above kMaxMessageBytes
};
inline constexpr int kNumDecodeStatuses = 6;
[[nodiscard]] std::string_view Name(DecodeStatus status);

inline constexpr std::size_t kMaxMessageBytes = 8u << 20;

// These are the fingerprints: the first eight bytes of each message, big-endian, which also stand
// for the version of its type. A released type is never edited, so these never change; a test
// compares them.
inline constexpr std::uint64_t kImuFingerprint = 0x4116ba332106780e;
inline constexpr std::uint64_t kScanFingerprint = 0x8a84c8aeb5c1b9ef;

// Unless the result is kOk, the outputs are unchanged or half filled and must not be used. Values
// are not judged here: a sample may be NaN, a chunk inconsistent.
[[nodiscard]] DecodeStatus DecodeImu(ByteView bytes, ImuSample& sample, std::int32_t& seq);
[[nodiscard]] DecodeStatus DecodeChunk(ByteView bytes,
                                       ScanChunk& chunk);  // reuses chunk.points' memory

[[nodiscard]] Bytes EncodeImu(const ImuSample& sample, std::int32_t seq);
// The stamp is truncated to whole microseconds and the points' offsets are moved to match.
[[nodiscard]] Bytes EncodeChunk(const ScanChunk& chunk);
[[nodiscard]] Bytes EncodeOdometry(const NavOutput& nav);
[[nodiscard]] Bytes EncodeLocalOdometry(const FilterReport& report);  // the pose in map
[[nodiscard]] Bytes EncodeBaseOdometry(const NavOutput& nav);         // needs nav.base
[[nodiscard]] Bytes EncodeFilterState(const FilterReport& report);
[[nodiscard]] Bytes EncodeRegistration(const ScanReport& report);
[[nodiscard]] Bytes EncodeCloud(const RegisteredCloud& cloud);

}  // namespace lio
