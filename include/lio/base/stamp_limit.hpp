// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Bounds the stamps that are taken from outside, in messages, files and arrays.
#pragma once

#include <cstdint>
#include <limits>

namespace lio {

// The latest stamp, in 2116, and the earliest by its sign: no difference of two overflows.
inline constexpr std::int64_t kMaxStamp_ns = std::numeric_limits<std::int64_t>::max() / 2;

}  // namespace lio
