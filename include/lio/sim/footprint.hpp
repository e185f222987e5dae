// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes one echo of a beam that is as wide as a real one: besides its centre, four sub-rays on its
// rim, left, right, below and above, tell which other surfaces it meets.
//
// An edge runs between a sub-ray and the centre if they meet different surfaces, at a place of the
// half width that is drawn. The edge cuts a disc, so the part of the light beyond it is that of
// a circle's segment. Two surfaces within reach of each other may give one echo in between, at
// their mean weighted by the light that each sends back; else the stronger one is returned.
#pragma once

#include <array>
#include <cstdint>

#include "lio/sim/echo.hpp"

namespace lio::sim {

inline constexpr std::size_t kNumSubRays = 4;  // left, right, below, above

// Holds what a beam meets at its rim.
struct Rim {
  std::array<Hit, kNumSubRays> hits;
  std::array<bool, kNumSubRays> is_beyond_edge{};  // on another surface than the centre
};

struct InBetween {
  float reach_m = 3.0f;  // widest gap between two surfaces with an echo in between
  double chance = 0.1;   // probability of such an echo when the gap is too wide to merge pulses
};

// Two echoes nearer than this merge into one: half the length of a pulse of 4 to 5 ns, as those of
// Velodyne's units are.
inline constexpr float kMergedEchoes_m = 0.6f;

// Returns the share of a disc's area beyond a chord at `distance` radii from the centre, 0..1.
[[nodiscard]] double ShareBeyondChord(double distance);

// `key` seeds the draws. The echo's surface is `kNothing` when the whole footprint meets nothing.
[[nodiscard]] Echo EchoOfFootprint(const Hit& centre, const Rim& rim, const InBetween& in_between,
                                   std::uint64_t key);

}  // namespace lio::sim
