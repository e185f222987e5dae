// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Orders a spinning lidar's points by ring, and reconstructs rings and times when the source lacks
// them. Points in the lidar frame, metres.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lio/sensor/scan_chunk.hpp"

namespace lio {

// True when every point has ring 0: every spinning lidar has several beams.
bool LacksRings(std::span<const LidarPoint> points);

// Returns the beam nearest in elevation for each point; 0 for non-finite points.
// `beam_elevations_rad` ascends; throws std::invalid_argument when it is empty.
std::vector<std::uint16_t> RingsFromElevation(std::span<const LidarPoint> points,
                                              std::span<const double> beam_elevations_rad);

// Returns true when all points have one and the same time.
bool LacksTimes(std::span<const LidarPoint> points);

// The time of each point as a fraction 0..1 of the turn, from its azimuth alone: the sensor turns
// clockwise seen from above and the turn begins at the first finite point, whose azimuth may be
// anything.
std::vector<float> TurnFractions(std::span<const LidarPoint> points);

// Holds points ring after ring, each ring in the order of measurement: by time or, when the points
// lack it, by azimuth as in TurnFractions. Ties are broken by position, so that with times the
// order of the input does not matter.
struct RingOrder {
  std::vector<std::uint32_t> points;  // indices
  std::vector<std::uint32_t> begin;   // in `points`, by ring, and the end of the last one

  std::size_t num_rings() const { return begin.size() - 1; }
  std::span<const std::uint32_t> ring(std::size_t i) const {
    return std::span(points).subspan(begin[i], begin[i + 1] - begin[i]);
  }
};

// `rings` has one ring per point, or is empty for the points' own; points whose `is_wanted` is 0
// are left out.
RingOrder OrderByRing(std::span<const LidarPoint> points, std::span<const std::uint16_t> rings,
                      std::span<const std::uint8_t> is_wanted);

}  // namespace lio
