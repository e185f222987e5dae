// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Trunks, bushes and edges look different from each side, by some centimetres: they tell where the
// vehicle is only while that is known no better.
#pragma once

#include "lio/registration/scan_matcher.hpp"

namespace lio {

// Is the shift since the last scan known better than such things can tell?
inline bool IsTranslationWellConstrained(const MatchInput& input) {
  constexpr double kMaxShiftStd_m = 0.02;
  return input.shift_std_m <= kMaxShiftStd_m;
}

}  // namespace lio
