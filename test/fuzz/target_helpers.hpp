// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Helps a target: what may be thrown, and the parts of an input.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "lio/io/lcm_codec.hpp"

namespace lio::fuzz {

// Readers of whole files refuse with a std::runtime_error; any other exception is a fault.
template <typename Read>
void MayRefuse(Read&& read) {
  try {
    std::forward<Read>(read)();
  } catch (const std::runtime_error&) {
  }
}

inline std::string_view TextOf(ByteView bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Cuts off what stands in front of the next zero byte, without it: all when there is none.
inline ByteView CutPart(ByteView& bytes) {
  const std::size_t end = std::min(TextOf(bytes).find('\0'), bytes.size());
  const ByteView part = bytes.first(end);
  bytes = bytes.subspan(std::min(end + 1, bytes.size()));
  return part;
}

}  // namespace lio::fuzz
