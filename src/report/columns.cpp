// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "columns.hpp"

#include <cmath>

namespace lio {

nlohmann::ordered_json RoundedForPlot(double value) {
  if (!std::isfinite(value)) return nullptr;
  if (value == 0.0) return 0;
  constexpr int kDigits = 5;
  const int digits_after_point =
      kDigits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value))));
  // Powers of ten below 1 are inexact, so the larger of the two scales is used.
  const double scale = std::pow(10.0, std::abs(digits_after_point));
  return digits_after_point >= 0 ? std::round(value * scale) / scale
                                 : std::round(value / scale) * scale;
}

std::size_t RowStride(std::size_t num_rows) {
  return std::max<std::size_t>(1, (num_rows + kMaxRows - 1) / kMaxRows);
}

void PlotColumns::AddTime(Timestamp stamp) {
  columns_["t"].push_back(std::round(SecondsBetween(begin_, stamp) * 1e3) / 1e3);
}

void PlotColumns::Add(const std::string& name, double value) {
  columns_[name].push_back(RoundedForPlot(value));
}

}  // namespace lio
