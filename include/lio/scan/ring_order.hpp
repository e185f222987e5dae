// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A spinning lidar's points ring by ring, and rings and times where the source has none of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lio/sensor/scan_chunk.hpp"

namespace lio {

// True when every point has ring 0: no spinning lidar has one beam.
bool LacksRings(std::span<const LidarPoint> points);

// The beam nearest in elevation for each point. `beam_elevations_rad`: ascending, not empty.
// Non-finite points get ring 0.
std::vector<std::uint16_t> RingsFromElevation(std::span<const LidarPoint> points,
                                              std::span<const double> beam_elevations_rad);

// True when all points have one and the same time.
bool LacksTimes(std::span<const LidarPoint> points);

// When in the turn each point was measured, 0..1, from its azimuth alone: the sensor turns
// clockwise seen from above and the turn begins at the first finite point. That point may have any
// azimuth, so a turn may well run across the wrap at 180 degrees.
std::vector<float> TurnFractions(std::span<const LidarPoint> points);

// Points ring after ring, each ring in the order it was measured: by time or, where the points lack
// it, by azimuth as in TurnFractions. Equal ones by position, so that, with times, the order of the
// input does not matter.
struct RingOrder {
  std::vector<std::uint32_t> points;  // indices
  std::vector<std::uint32_t> begin;   // in `points`, by ring, and the end of the last one

  std::size_t num_rings() const { return begin.size() - 1; }
  std::span<const std::uint32_t> ring(std::size_t i) const {
    return std::span(points).subspan(begin[i], begin[i + 1] - begin[i]);
  }
};

// `rings`: of each point, or empty for the points' own. `is_wanted`: of each point; others are left
// out.
RingOrder OrderByRing(std::span<const LidarPoint> points, std::span<const std::uint16_t> rings,
                      std::span<const std::uint8_t> is_wanted);

}  // namespace lio
