// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Summarizes samples.
#pragma once

#include <vector>

namespace lio {

// Holds statistics of the samples' absolute values. All are zero when count is 0.
struct ErrorStats {
  int count = 0;
  double rmse = 0;
  double mean = 0;
  double median = 0;
  double max = 0;
};

[[nodiscard]] ErrorStats Summarise(std::vector<double> samples);

// Returns the middle value, or the mean of the two in the middle; 0 for no samples.
[[nodiscard]] double Median(std::vector<double> samples);

}  // namespace lio
