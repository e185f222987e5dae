// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tells what comes back along a beam: how strong, at which intensity, and how far off the range is
// by the strength alone.
#pragma once

#include <cstdint>

#include "lio/sim/scene.hpp"

namespace lio::sim {

// Says how a return came about; it is known to the simulator only and never travels in messages.
enum class EchoKind : std::uint8_t {
  kSurface,       // the surface that the beam meets
  kInBetween,     // a mixed pixel: between the two surfaces of an edge
  kMirrored,      // a surface that the beam met after a reflection; it lies behind the mirror
  kThroughGlass,  // a surface behind a pane
  kDust,
};

// Holds one echo before noise.
struct Echo {
  double range_m = 0.0;
  Hit surface;            // the surface that sends it back
  double strength = 1.0;  // share of the light that takes this way, there and back
  EchoKind kind = EchoKind::kSurface;
  double off_surface_m = 0.0;  // in between: from the nearer of the two surfaces
};

// Holds the range error that grows with the strength of the echo ("range walk": a stronger pulse
// crosses the threshold earlier).
struct RangeWalk {
  // The range grows by this with each doubling of a matt surface's strength. Chosen: from 5 to 80 %
  // it makes 16 mm, within the 2 to 3 cm that the makers of these lidars state for 10 to 80 %
  // targets.
  double per_doubling_m = 0.0;
  // Retroreflectors, which saturate the receiver, look nearer. It is half of the 10 cm that the
  // data sheet of the OS1 has for them, where it has 3 cm for matt targets.
  double retro_m = 0.0;
};

// Returns the light that comes back from a surface at 1 m; a white matt one gives 1.
[[nodiscard]] double Backscatter(const MaterialTraits& traits, double cos_incidence);
[[nodiscard]] double BackscatterOf(const Echo& echo);

// Returns Velodyne's scale: matt surfaces have 0..100 in per cent, retroreflectors 101..255.
[[nodiscard]] std::uint16_t IntensityOf(double backscatter);

// Returns the range error [m] of an echo of this backscatter.
[[nodiscard]] double RangeWalkOf(const RangeWalk& walk, double backscatter);

}  // namespace lio::sim
