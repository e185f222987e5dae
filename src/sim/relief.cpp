// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/relief.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lio/sim/random.hpp"

namespace lio::sim {
namespace {

// Describes noise that is drawn on a lattice and goes on smoothly between its nodes. The sizes are
// those of clods or shoots and of the tufts that they form; chosen.
struct Octave {
  double cell_m;
  double share;  // part of the relief that it makes
};
constexpr std::array<Octave, 2> kOctaves = {{{0.07, 0.6}, {0.25, 0.4}}};

constexpr double kMinStep_m = 0.004;  // a ray's march has this at least; a fifth of the range noise
constexpr double kSteepest = 1.5;     // the relief rises by less than this per metre of way
constexpr double kMaxMarch_m = 4.0;   // way through the relief that is followed
constexpr double kSmallestSine = 0.01;  // a ray meets the surface at this sine at least

// Returns the noise at a node of the lattice, -1 to 1. One mixing of a sum with odd factors is
// enough, since no draw depends on the noise.
double NodeOf(std::size_t octave, const std::array<std::int64_t, 3>& cell) {
  const auto part = [&](std::size_t i) { return static_cast<std::uint64_t>(cell[i]); };
  const std::uint64_t place = 0x9E3779B97F4A7C15ull * part(0) + 0xC2B2AE3D27D4EB4Full * part(1) +
                              0x165667B19E3779F9ull * part(2);
  return 2.0 * UnitInterval(MixBits(place + octave)) - 1.0;
}

// Returns the noise of one octave, -1 to 1.
double NoiseAt(std::size_t octave, const Vector3& p_m) {
  std::array<std::int64_t, 3> low{};
  Vector3 share;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double at = p_m[static_cast<Eigen::Index>(axis)] / kOctaves[octave].cell_m;
    low[axis] = static_cast<std::int64_t>(std::floor(at));
    share[static_cast<Eigen::Index>(axis)] = at - std::floor(at);
  }
  double noise = 0.0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    std::array<std::int64_t, 3> cell = low;
    double weight = 1.0;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const bool is_high = (corner >> axis & 1u) != 0;
      cell[axis] += is_high ? 1 : 0;
      weight *= is_high ? share[axis] : 1.0 - share[axis];
    }
    noise += weight * NodeOf(octave, cell);
  }
  return noise;
}

}  // namespace

double ReliefAt(const MaterialTraits& traits, const Vector3& p_m) {
  double relief_m = 0.0;
  for (std::size_t i = 0; i < kOctaves.size(); ++i) {
    relief_m += traits.relief_m * kOctaves[i].share * NoiseAt(i, p_m);
  }
  return relief_m;
}

float RangeOnRelief(const Ray& ray, const Hit& hit) {
  const MaterialTraits& traits = TraitsOf(hit.material);
  if (traits.relief_m <= 0.0) return hit.range_m;
  const Vector3 origin = ray.origin_m.cast<double>();
  const Vector3 direction = ray.direction.cast<double>();
  const double sine = std::max(kSmallestSine, double{hit.cos_incidence});
  const double deep_m = std::min(traits.relief_m / sine, kMaxMarch_m);
  // The march ends where the ray would be below the deepest hollow.
  const double end_m = hit.range_m + deep_m;
  double range_m = std::max(0.0, hit.range_m - deep_m);
  while (range_m < end_m) {
    const double above_mesh_m = (hit.range_m - range_m) * sine;
    const double above_m = above_mesh_m - ReliefAt(traits, origin + range_m * direction);
    if (above_m <= 0.0) break;
    range_m += std::max(kMinStep_m, above_m / (sine + kSteepest));
  }
  return static_cast<float>(std::min(range_m, end_m));
}

}  // namespace lio::sim
