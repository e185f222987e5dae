// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Limits of the text at the head of a cloud file, far above what programs write: a header beyond
// them is none.
#pragma once

#include <cstddef>

namespace lio {

inline constexpr std::size_t kMaxHeaderLineBytes = 4096;
inline constexpr int kMaxPcdHeaderLines = 100;  // comments included; keys are ten
inline constexpr int kMaxPlyHeaderLines = 1000;

}  // namespace lio
