// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The judges of both clocks share these: the usual one of several lags, and the words for a clock
// that stepped alone.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "lio/base/time.hpp"

namespace lio {

// Returns the upper median; there must be one lag at least.
inline Duration MedianOf(std::vector<Duration> lags) {
  const auto middle = lags.begin() + std::ssize(lags) / 2;
  std::ranges::nth_element(lags, middle);
  return *middle;
}

// `shift` is added to the stamps of that sensor from here on.
inline std::string TextOfLoneStep(std::string_view stepped, std::string_view other, double step_s,
                                  Duration shift) {
  return fmt::format(
      "the {0}'s clock stepped by {2:.3f} s and the {1}'s did not: the {0}'s stamps are now "
      "shifted by {3:.3f} s; nothing need be done",
      stepped, other, step_s, shift.Seconds());
}

}  // namespace lio
