// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Casts all beams of one turn into the scene, each from the pose that the sensor has at the instant
// it fires, and the further rays that some of them need: sub-rays on the rim of a beam that may
// straddle an edge, and the ways on from polished surfaces.
#pragma once

#include <cstdint>
#include <vector>

#include "lio/sim/footprint.hpp"
#include "lio/sim/lidar_simulator.hpp"
#include "lio/sim/rotor.hpp"
#include "sim/polished.hpp"

namespace lio::sim {

inline constexpr float kRangeEdge_m = 0.12f;  // a larger step in range is an edge, not a slope

// The arrays are column-major, with one entry per ray.
struct SweepHits {
  static constexpr std::int32_t kNone = -1;

  std::vector<Hit> hits;
  std::vector<Matrix3> R_lidar_column;  // as the encoder reports them, one per column
  std::vector<std::int32_t> rim_of;     // index into `rims`, or none; empty: no sub-rays
  std::vector<std::int32_t> behind_of;  // index into `behinds`, or none; empty: nothing polished
  std::vector<Rim> rims;
  std::vector<Behind> behinds;

  [[nodiscard]] const Rim* RimOf(std::size_t ray) const {
    return rim_of.empty() || rim_of[ray] == kNone ? nullptr
                                                  : &rims[static_cast<std::size_t>(rim_of[ray])];
  }
  [[nodiscard]] const Behind* BehindOf(std::size_t ray) const {
    return behind_of.empty() || behind_of[ray] == kNone
               ? nullptr
               : &behinds[static_cast<std::size_t>(behind_of[ray])];
  }
};

// Each beam's true direction when the column's heading is 0, and the sensor it belongs to. All is
// borrowed.
struct CastSetup {
  const LidarSetup& lidar;
  const std::vector<Vector3>& directions;
  const Rotor& rotor;
  const Scene& scene;
  const Trajectory& trajectory;
};

[[nodiscard]] SweepHits CastSweep(const CastSetup& setup, const TurnColumns& columns);

}  // namespace lio::sim
