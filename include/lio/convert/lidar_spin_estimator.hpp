// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Estimates how a spinning lidar turns from the first clouds of a recording: the order of its
// points, the direction and rate of the head, and each ring's azimuth offset.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lio/convert/azimuth_time.hpp"
#include "lio/io/beam_table.hpp"

namespace lio {

class LidarSpinEstimator {
 public:
  static constexpr int kNumOffsetBins = 1200;

  void Add(const CloudPoints& points, std::span<const std::uint16_t> rings, Timestamp stamp);
  // `table` is the model that the user named, if any; it gives direction and offsets if the data do
  // not. Throws InputError when the points are in no known order and do not cover the whole circle.
  [[nodiscard]] SpinModel Decide(const std::optional<BeamTable>& table) const;

 private:
  struct Seen {
    Timestamp stamp;
    PointOrder order = PointOrder::kNone;
    double direction = 0.0;  // 0: unknown
    double first_azimuth_rad = 0.0;
    double covered_rad = 0.0;
    double coverage_ratio = 0.0;  // share of the circle
  };

  void AddOffsets(std::span<const std::uint16_t> rings, const Seen& seen,
                  const UnwrappedSweep& sweep);
  [[nodiscard]] std::vector<double> RingOffsets() const;
  [[nodiscard]] double Rate(double direction, PointOrder order, double fallback_hz,
                            std::string& how) const;

  std::vector<Seen> seen_;
  // Histogram of offsets for each ring: its median is not affected by edges of gaps in the returns.
  std::vector<std::array<std::int32_t, kNumOffsetBins>> offsets_;
};

}  // namespace lio
