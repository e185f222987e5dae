// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds out how a spinning lidar turns from the first clouds of a recording: in which order their
// points come, which way and how fast the head turns, and how far each ring is ahead or behind.
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
  // `table`: the model the user named, if any; it gives direction and offsets where the data does
  // not. Throws InputError when the points neither are in order nor go all round.
  SpinModel Decide(const std::optional<BeamTable>& table) const;

 private:
  struct Seen {
    Timestamp stamp;
    PointOrder order = PointOrder::kNone;
    double direction = 0.0;  // 0: unknown
    double first_azimuth_rad = 0.0;
    double covered_rad = 0.0;
    double coverage_ratio = 0.0;  // of the circle
  };

  void AddOffsets(std::span<const std::uint16_t> rings, const Seen& seen,
                  const UnwrappedSweep& sweep);
  std::vector<double> RingOffsets() const;
  double Rate(double direction, PointOrder order, double fallback_hz, std::string& how) const;

  std::vector<Seen> seen_;
  // By ring, how often which offset: medians do not mind the edges of gaps in the returns.
  std::vector<std::array<std::int32_t, kNumOffsetBins>> offsets_;
};

}  // namespace lio
