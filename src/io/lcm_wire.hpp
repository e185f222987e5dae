// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Helpers of the codecs, and the latest stamp that they accept.
#pragma once

#include <bit>
#include <cstdint>
#include <stdexcept>
#include <type_traits>

#include "lio/base/stamp_limit.hpp"
#include "lio/io/lcm_codec.hpp"

namespace lio {

inline constexpr std::int64_t kMaxUtime = kMaxStamp_ns / 1000;  // us

// Reads big-endian fields one after another. The caller has checked the size.
class FieldReader {
 public:
  explicit FieldReader(const std::uint8_t* data) : next_(data) {}

  template <typename T>
  T Read() {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) bits = bits << 8 | *next_++;
    if constexpr (sizeof(T) == 8) {
      return std::bit_cast<T>(bits);
    } else if constexpr (std::is_same_v<T, float>) {
      return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    } else {
      return static_cast<T>(bits);
    }
  }
  Vector3 ReadVector() {
    const double x = Read<double>();
    const double y = Read<double>();
    const double z = Read<double>();
    return {x, y, z};
  }

 private:
  const std::uint8_t* next_;
};

// Returns kOk when `bytes` is a message of the type and has at least its fixed part.
[[nodiscard]] inline DecodeStatus CheckHead(ByteView bytes, std::uint64_t fingerprint,
                                            std::size_t fixed_bytes) {
  if (bytes.size() > kMaxMessageBytes) return DecodeStatus::kTooLarge;
  if (bytes.size() < sizeof(fingerprint)) return DecodeStatus::kTruncated;
  if (FieldReader(bytes.data()).Read<std::uint64_t>() != fingerprint) {
    return DecodeStatus::kWrongType;
  }
  return bytes.size() < fixed_bytes ? DecodeStatus::kTruncated : DecodeStatus::kOk;
}

// Encodes by the generated code; the counts in `message` must agree with its vectors.
template <typename Message>
[[nodiscard]] Bytes EncodeMessage(const Message& message) {
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  const int written = message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  if (written != static_cast<int>(bytes.size())) throw std::logic_error("message did not encode");
  return bytes;
}

}  // namespace lio
