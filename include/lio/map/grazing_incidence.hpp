// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The grazing-incidence test: no surface is seen along itself. Points of a single ring through a
// tree's crown or a hedge make such a plane, which is the beam's own cone
// (docs/experiments/grazing_incidence.md).
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "lio/map/map_parameters.hpp"

namespace lio {

// `normal` is a unit vector. `view` points along the beams that saw the surface, of any length; a
// view of zero or of no numbers counts as grazing.
[[nodiscard]] inline bool IsGrazing(const Eigen::Vector3f& normal, const Eigen::Vector3f& view) {
  return !(std::abs(normal.dot(view)) > GrazingIncidenceParameters::kMinSine * view.norm());
}

// Does the beam come from the other side than the beams that saw the surface before, to which
// `normal` points? Then it hit another surface: floors have a ceiling below them, walls a room
// behind.
[[nodiscard]] inline bool IsFromBehind(const Eigen::Vector3f& normal, const Eigen::Vector3f& view) {
  return normal.dot(view) > GrazingIncidenceParameters::kMinSine * view.norm();
}

}  // namespace lio
