// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Puts tables into the page's data: a JSON object with one array per column, rounded and thinned so
// that the page of an hour's run still opens at once.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "lio/base/time.hpp"

namespace lio {

inline constexpr std::size_t kMaxRows = 20'000;  // half an hour at 10 Hz

// Returns the number with five digits, which is more than a plot shows; null for what is not
// finite.
[[nodiscard]] nlohmann::ordered_json RoundedForPlot(double value);

// Returns how many rows make one kept row, so that at most kMaxRows are kept.
[[nodiscard]] std::size_t RowStride(std::size_t num_rows);

class PlotColumns {
 public:
  // All times are counted from `begin`.
  explicit PlotColumns(Timestamp begin) : begin_(begin) {}

  // Begins a row: adds its time [s, to the millisecond].
  void AddTime(Timestamp stamp);
  void Add(const std::string& name, double value);

  [[nodiscard]] const nlohmann::ordered_json& json() const { return columns_; }

 private:
  Timestamp begin_;
  nlohmann::ordered_json columns_ = nlohmann::ordered_json::object();
};

}  // namespace lio
