// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Summaries of samples.
#pragma once

#include <vector>

namespace lio {

// All zero when count is 0. Of absolute values: signs of the samples do not matter.
struct ErrorStats {
  int count = 0;
  double rmse = 0;
  double mean = 0;
  double median = 0;
  double max = 0;
};

ErrorStats Summarise(std::vector<double> samples);

// The middle value, or the mean of the two in the middle; 0 for none.
double Median(std::vector<double> samples);

}  // namespace lio
