// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives grass, tilled soil and clipped hedges a relief that is finer than their mesh: tufts, clods
// and shoots. A beam ends on the first of them that it meets, so that at grazing incidence only the
// tops are seen. It is used inside src/sim only.
#pragma once

#include "lio/sim/scene.hpp"

namespace lio::sim {

// Returns by how much the relief of a material stands out from its mesh at a point [m], negative
// below it; it is at most the relief of the material's traits either way.
[[nodiscard]] double ReliefAt(const MaterialTraits& traits, const Vector3& p_m);

// Returns the range at which the ray meets the relief of the surface that it hits.
[[nodiscard]] float RangeOnRelief(const Ray& ray, const Hit& hit);

}  // namespace lio::sim
