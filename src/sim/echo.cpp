// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/echo.hpp"

#include <algorithm>
#include <cmath>

namespace lio::sim {
namespace {

constexpr double kLobe_rad = 0.07;          // half width of a polished surface's lobe
constexpr double kMiddleBackscatter = 0.3;  // the makers calibrate near it: no range walk there
constexpr double kLeastBackscatter = 0.02;

}  // namespace

double Backscatter(const MaterialTraits& traits, double cos_incidence) {
  double strength = traits.reflectivity * std::sqrt(cos_incidence);
  if (traits.specular > 0.0 && cos_incidence > 0.97) {
    const double off_sq = 2.0 * (1.0 - cos_incidence) / (kLobe_rad * kLobe_rad);
    strength += 2.0 * traits.specular * std::exp(-off_sq);
  }
  return strength;
}

double BackscatterOf(const Echo& echo) {
  return echo.strength * Backscatter(TraitsOf(echo.surface.material), echo.surface.cos_incidence);
}

std::uint16_t IntensityOf(double backscatter) {
  const double value =
      backscatter <= 1.0 ? 100.0 * backscatter : 100.0 + 60.0 * (backscatter - 1.0);
  return static_cast<std::uint16_t>(std::clamp(value, 0.0, 255.0));
}

double RangeWalkOf(const RangeWalk& walk, double backscatter) {
  if (backscatter > 1.0) return -walk.retro_m;
  const double doublings = std::log2(std::max(backscatter, kLeastBackscatter) / kMiddleBackscatter);
  return -walk.per_doubling_m * doublings;
}

}  // namespace lio::sim
