// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives quantiles of any number of positive values in bounded memory, e.g. of the computing times
// of the scans of a run that lasts for days.
//
// The first kMaxExact values are kept, and their quantiles are exact. After them the values are
// counted in bins whose edges grow by 1 % from bin to bin, and a quantile is the middle of its bin:
// at most 0.5 % from the value of that rank. The smallest and the largest value are always exact.
// The result does not depend on chance, nor on the order of the values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lio {

class QuantileSketch {
 public:
  static constexpr std::size_t kMaxExact = 4096;  // 32 kB; seven minutes of scans at 10 Hz
  // The bins have this range. Values outside it are counted at its ends.
  static constexpr double kMinBinned = 1e-6;
  static constexpr double kMaxBinned = 1e6;

  void Add(double value);

  [[nodiscard]] bool empty() const { return count_ == 0; }
  // Returns the value of rank round(fraction * (count - 1)) among the sorted values; `fraction` is
  // within 0 .. 1. Throws std::logic_error when there are no values.
  [[nodiscard]] double Quantile(double fraction) const;
  [[nodiscard]] double min() const { return min_; }  // 0 when there are no values
  [[nodiscard]] double max() const { return max_; }

  // Returns the memory of the values or of their bins: at most 32 kB.
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  void AddToBin(double value);
  [[nodiscard]] double BinnedQuantile(std::uint64_t rank) const;

  std::uint64_t count_ = 0;
  double min_ = 0.0;
  double max_ = 0.0;
  std::vector<double> values_;       // all of them, as long as they are few
  std::vector<std::uint64_t> bins_;  // afterwards: how many values each bin has
};

}  // namespace lio
