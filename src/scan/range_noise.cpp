// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/range_noise.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scan/scan_parameters.hpp"

namespace lio {

void RangeNoiseEstimator::Add(const MixedPixelFinder& finder, std::size_t num_points) {
  constexpr RangeNoiseParameters kRangeNoise = kScanParameters.range_noise;
  offsets_m_.clear();
  const std::size_t step = std::max<std::size_t>(1, num_points / kRangeNoise.num_tried);
  for (std::size_t i = 0; i < num_points; i += step) {
    const std::optional<float> offset_m = finder.OffsetFromPlane(static_cast<std::uint32_t>(i));
    if (offset_m) offsets_m_.push_back(std::abs(*offset_m));
  }
  if (offsets_m_.size() < kRangeNoise.min_points) return;
  const auto quarter = offsets_m_.begin() + static_cast<std::ptrdiff_t>(offsets_m_.size() / 4);
  std::nth_element(offsets_m_.begin(), quarter, offsets_m_.end());
  const float now_m = kRangeNoise.std_per_quartile * *quarter;
  std_m_ = std_m_ == 0.f ? now_m : std_m_ + kRangeNoise.rate * (now_m - std_m_);
}

}  // namespace lio
