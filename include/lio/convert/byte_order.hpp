// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads numbers from unaligned bytes in either byte order. This project runs on little-endian
// machines.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace lio {

static_assert(std::endian::native == std::endian::little);

// Returns the T that begins at `bytes`; sizeof(T) bytes must be there.
template <typename T>
[[nodiscard]] T LoadAs(const std::uint8_t* bytes, bool big_endian = false) {
  static_assert(std::is_arithmetic_v<T>);
  std::array<std::uint8_t, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes, sizeof(T));
  if (big_endian) std::reverse(raw.begin(), raw.end());
  if constexpr (std::is_same_v<T, bool>) {
    return raw[0] != 0;
  } else {
    return std::bit_cast<T>(raw);
  }
}

}  // namespace lio
