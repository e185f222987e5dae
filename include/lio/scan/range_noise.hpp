// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Estimates the noise of a lidar's ranges from its sweeps alone: on a plane a return lies where its
// neighbours on the ring say (MixedPixelFinder), and how far it is off is noise. Nothing throws.
#pragma once

#include <cstddef>
#include <vector>

#include "lio/scan/mixed_pixels.hpp"

namespace lio {

class RangeNoiseEstimator {
 public:
  // Takes a sweep that the finder has loaded. One that shows too little changes nothing.
  void Add(const MixedPixelFinder& finder, std::size_t num_points);
  // 1 sigma [m]; zero before any sweep has shown it.
  [[nodiscard]] float std_m() const { return std_m_; }

 private:
  float std_m_ = 0.f;
  std::vector<float> offsets_m_;  // scratch
};

}  // namespace lio
