// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/quantile_sketch.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace lio {
namespace {

constexpr double kGrowth = 1.01;  // from the edge of a bin to the next

std::size_t BinOf(double value) {
  const double clamped = std::clamp(value, QuantileSketch::kMinBinned, QuantileSketch::kMaxBinned);
  return static_cast<std::size_t>(std::log(clamped / QuantileSketch::kMinBinned) /
                                  std::log(kGrowth));
}

// The middle is equally far from both edges, as a ratio.
double MiddleOf(std::size_t bin) {
  return QuantileSketch::kMinBinned * std::pow(kGrowth, static_cast<double>(bin) + 0.5);
}

}  // namespace

void QuantileSketch::Add(double value) {
  min_ = count_ == 0 ? value : std::min(min_, value);
  max_ = count_ == 0 ? value : std::max(max_, value);
  ++count_;
  if (bins_.empty() && values_.size() < kMaxExact) {
    values_.push_back(value);
    return;
  }
  if (bins_.empty()) {
    bins_.resize(BinOf(kMaxBinned) + 1);
    for (const double kept : std::exchange(values_, {})) AddToBin(kept);
  }
  AddToBin(value);
}

void QuantileSketch::AddToBin(double value) {
  ++bins_[BinOf(value)];
}

double QuantileSketch::Quantile(double fraction) const {
  if (empty()) throw std::logic_error("quantile of no values");
  const auto rank =
      static_cast<std::uint64_t>(std::llround(fraction * static_cast<double>(count_ - 1)));
  if (!bins_.empty()) return BinnedQuantile(rank);
  std::vector<double> values = values_;
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

double QuantileSketch::BinnedQuantile(std::uint64_t rank) const {
  std::uint64_t num_below = 0;
  std::size_t bin = 0;
  while (num_below + bins_[bin] <= rank) num_below += bins_[bin++];
  return std::clamp(MiddleOf(bin), min_, max_);
}

std::size_t QuantileSketch::memory_bytes() const {
  return values_.capacity() * sizeof(double) + bins_.capacity() * sizeof(std::uint64_t);
}

}  // namespace lio
