// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives the words for the stages of a scan in files.
#pragma once

#include <array>
#include <cstdint>

#include "lio/pipeline/outputs.hpp"

namespace lio {

inline constexpr std::array<const char*, kNumStages> kStageNames = {
    "decode", "reduce", "deskew", "match", "insert", "filter", "total"};

[[nodiscard]] inline double Milliseconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-6;
}

}  // namespace lio
