// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lio {

// Returns the middle value, the upper one of the two in the middle; 0 for none.
[[nodiscard]] inline double UpperMedian(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace lio
