// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes the echo of a beam that meets glass, paint or polished metal. The light takes up to three
// ways: a little comes back from the surface itself; some is reflected as by a mirror, meets
// something and comes back the same way, so that it is seen behind the mirror at the whole length
// of its way; and through glass it goes on to what is behind. The strongest of the three is
// returned, as by a lidar in its usual mode.
#pragma once

#include "lio/sim/echo.hpp"

namespace lio::sim {

struct PolishParameters {
  double min_specular = 0.3;  // least of a material that reflects as a mirror does. Chosen.
  // A mirror returns this share of the light at normal incidence; towards grazing it grows to all
  // by Schlick's formula. Two faces of glass of index 1.5 give 8 %, the clear coat of paint 4 %.
  double glass_reflectance = 0.08;
  double coat_reflectance = 0.04;
  // One way through a window lets this share pass besides reflection: double glazing of float
  // glass, whose iron takes 0.2 to 0.3 of the light near 900 nm a pane.
  double glass_transmittance = 0.55;
  // A pane's other face, and the frame of a pane modelled as a box, are skipped.
  float pane_m = 0.12f;
};
inline constexpr PolishParameters kPolish;

// Holds what the two further ways of the light meet, counted from the polished surface.
struct Behind {
  Hit mirrored;
  Hit through;
};

// Returns the share of light reflected by a polished surface.
[[nodiscard]] double Reflectance(Material material, double cos_incidence);

// Tells whether something white next to the surface, seen through it or in it, could outshine it.
[[nodiscard]] bool MayShowOthers(const Hit& surface);

// `surface` must be one that may show others. Returns its own echo or one of the two others.
[[nodiscard]] Echo EchoOfPolished(const Hit& surface, const Behind& behind);

}  // namespace lio::sim
