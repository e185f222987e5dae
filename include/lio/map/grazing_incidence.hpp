// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A surface that is seen edge-on cannot be one: points of a single ring through a crown or a hedge
// make such a plane, which is the beam's own cone (docs/filter.md, "ring lock").
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace lio {

// `normal`: unit. `view`: along the beams that saw it, of any length; none at all counts as
// edge-on.
inline bool IsGrazing(const Eigen::Vector3f& normal, const Eigen::Vector3f& view) {
  constexpr float kMinSine = 0.06f;  // between surface and beam: 3.4 deg
  return !(std::abs(normal.dot(view)) > kMinSine * view.norm());
}

}  // namespace lio
