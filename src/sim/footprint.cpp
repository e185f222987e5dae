// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/footprint.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lio/sim/random.hpp"

namespace lio::sim {
namespace {

// An echo nearer than this to one of its surfaces counts as that surface's: 2.5 times the range
// noise of a data sheet.
constexpr double kOnSurface_m = 0.05;

struct Part {
  const Hit* hit = nullptr;
  double share = 0.0;   // share of the beam's light that falls on it
  double energy = 0.0;  // part of that light that comes back
};

Part MakePart(const Hit& hit, double share) {
  if (hit.object == Hit::kNothing) return {&hit, share, 0.0};
  const double backscatter = Backscatter(TraitsOf(hit.material), hit.cos_incidence);
  return {&hit, share, share * backscatter / (double{hit.range_m} * hit.range_m)};
}

Echo EchoOf(const Part& part) {
  return {part.hit->range_m, *part.hit, part.share, EchoKind::kSurface};
}

}  // namespace

double ShareBeyondChord(double distance) {
  const double d = std::clamp(distance, 0.0, 1.0);
  return (std::acos(d) - d * std::sqrt(1.0 - d * d)) / std::numbers::pi;
}

Echo EchoOfFootprint(const Hit& centre, const Rim& rim, const InBetween& in_between,
                     std::uint64_t key) {
  Part other{&centre, 0.0, 0.0};
  double share_of_centre = 1.0;
  for (std::size_t i = 0; i < kNumSubRays; ++i) {
    if (!rim.is_beyond_edge[i]) continue;
    const double share = ShareBeyondChord(UnitInterval(MixBits(key + i)));
    share_of_centre -= share;
    const Part part = MakePart(rim.hits[i], share);
    if (part.energy > other.energy) other = part;
  }
  const Part mine = MakePart(centre, std::max(0.0, share_of_centre));
  if (other.energy <= 0.0) return EchoOf(mine);
  if (mine.energy <= 0.0) return EchoOf(other);
  const double gap_m = double{other.hit->range_m} - centre.range_m;
  const bool merges = std::abs(gap_m) < kMergedEchoes_m;
  const bool is_drawn = std::abs(gap_m) < in_between.reach_m &&
                        UnitInterval(MixBits(key + kNumSubRays)) < in_between.chance;
  const Part& stronger = other.energy > mine.energy ? other : mine;
  Echo echo = EchoOf(stronger);
  if (!merges && !is_drawn) return echo;
  echo.range_m = centre.range_m + gap_m * other.energy / (mine.energy + other.energy);
  echo.strength = std::min(1.0, mine.share + other.share);
  echo.off_surface_m = std::min(std::abs(echo.range_m - centre.range_m),
                                std::abs(echo.range_m - double{other.hit->range_m}));
  if (echo.off_surface_m > kOnSurface_m) echo.kind = EchoKind::kInBetween;
  return echo;
}

}  // namespace lio::sim
