// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the messages that liod sends, for viewers and exports: the other direction of lcm_codec.hpp
// and status_report.hpp, with the same checks before a byte is used. Nothing here throws.
#pragma once

#include "lio/io/lcm_codec.hpp"
#include "lio/io/status_report.hpp"

namespace lio {

inline constexpr std::uint64_t kOdometryFingerprint = 0x6aef2ca12689f54b;
inline constexpr std::uint64_t kFilterStateFingerprint = 0x6dcb6ac3c994fbda;
inline constexpr std::uint64_t kRegistrationFingerprint = 0x596baba604d08b4a;
inline constexpr std::uint64_t kStatusFingerprint = 0xc3f4d4099fe275d9;

// Unless the result is kOk the outputs are unchanged or half filled and must not be used. Fields
// that the message does not have keep their defaults. Numbers are finite, quaternions of unit norm
// and enumerators known; other values are refused as kBadFormat.
[[nodiscard]] DecodeStatus DecodeOdometry(ByteView bytes, NavOutput& nav);  // for all five channels
[[nodiscard]] DecodeStatus DecodeFilterState(ByteView bytes, FilterReport& report);
[[nodiscard]] DecodeStatus DecodeRegistration(ByteView bytes, ScanReport& report);
[[nodiscard]] DecodeStatus DecodeStatusReport(ByteView bytes, StatusReport& report);

}  // namespace lio
