// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/polished.hpp"

#include <cmath>

namespace lio::sim {
namespace {

// Returns the strength at the receiver.
double Received(const Echo& echo) {
  return BackscatterOf(echo) / (echo.range_m * echo.range_m);
}

}  // namespace

double Reflectance(Material material, double cos_incidence) {
  const double normal =
      material == Material::kGlass ? kPolish.glass_reflectance : kPolish.coat_reflectance;
  return normal + (1.0 - normal) * std::pow(1.0 - cos_incidence, 5);
}

bool MayShowOthers(const Hit& surface) {
  const MaterialTraits& traits = TraitsOf(surface.material);
  if (traits.specular < kPolish.min_specular) return false;
  if (surface.material == Material::kGlass) return true;
  const double reflectance = Reflectance(surface.material, surface.cos_incidence);
  return reflectance * reflectance > Backscatter(traits, surface.cos_incidence);
}

Echo EchoOfPolished(const Hit& surface, const Behind& behind) {
  Echo best{surface.range_m, surface, 1.0, EchoKind::kSurface};
  const auto consider = [&](const Hit& hit, double one_way, double offset_m, EchoKind kind) {
    if (hit.object == Hit::kNothing) return;
    const Echo echo{double{surface.range_m} + offset_m + hit.range_m, hit, one_way * one_way, kind};
    if (Received(echo) > Received(best)) best = echo;
  };
  const double reflectance = Reflectance(surface.material, surface.cos_incidence);
  consider(behind.mirrored, reflectance, 0.0, EchoKind::kMirrored);
  consider(behind.through, (1.0 - reflectance) * kPolish.glass_transmittance, kPolish.pane_m,
           EchoKind::kThroughGlass);
  return best;
}

}  // namespace lio::sim
