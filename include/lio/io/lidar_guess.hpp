// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Which lidar is it? Told by the elevations of its rings.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lio/io/beam_table.hpp"
#include "lio/sensor/scan_chunk.hpp"

namespace lio {

// Collects the elevation of each ring.
class RingElevations {
 public:
  void Add(const LidarPoint& point);
  // Returns the median elevation of each ring [rad], ring 0 first; empty where the points carry no
  // rings or some ring between has no point.
  [[nodiscard]] std::vector<double> Medians() const;

 private:
  std::vector<std::vector<float>> by_ring_;
};

struct LidarGuess {
  std::string model = "generic";
  std::string reason;  // says for users why
};

// Finds the model whose table has the same number of beams at the same elevations.
[[nodiscard]] LidarGuess GuessLidar(std::span<const double> elevations_rad,
                                    std::span<const BeamTable> known);

// Returns the tables of all models that are known.
[[nodiscard]] std::vector<BeamTable> KnownLidars();

}  // namespace lio
