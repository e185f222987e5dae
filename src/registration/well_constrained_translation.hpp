// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests for a well-constrained translation. Trunks, bushes and edges look different from each side,
// by some centimetres, and cars may drive off: the IMU may know better how far the vehicle moved.
#pragma once

#include "lio/registration/registration_parameters.hpp"
#include "lio/registration/scan_matcher.hpp"

namespace lio {

// Is the translation since the last scan known better than such things can tell?
[[nodiscard]] inline bool IsTranslationWellConstrained(const MatchInput& input) {
  return input.shift_std_m <= WellConstrainedTranslationParameters::kMaxStd_m;
}

// Is it known as well as at rest?
[[nodiscard]] inline bool IsShiftKnownAsAtRest(const MatchInput& input) {
  return input.shift_std_m <= WellConstrainedTranslationParameters::kAtRestStd_m;
}

}  // namespace lio
