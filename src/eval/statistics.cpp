// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace lio {

double Median(std::vector<double> samples) {
  if (samples.empty()) return 0;
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  if (samples.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(samples.begin(), middle));
}

ErrorStats Summarise(std::vector<double> samples) {
  ErrorStats stats;
  if (samples.empty()) return stats;
  for (double& sample : samples) {
    sample = std::abs(sample);
    stats.mean += sample;
    stats.rmse += sample * sample;
    stats.max = std::max(stats.max, sample);
  }
  stats.count = static_cast<int>(samples.size());
  stats.mean /= stats.count;
  stats.rmse = std::sqrt(stats.rmse / stats.count);
  stats.median = Median(std::move(samples));
  return stats;
}

}  // namespace lio
