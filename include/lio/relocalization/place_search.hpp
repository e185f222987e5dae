// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Relocalization after a time unseen: the bird's-eye view of now is laid over an earlier one,
// shifted and turned in every way within a range, first on a coarse grid, then around the best
// poses on a fine one (correlative scan matching, E. Olson, ICRA 2009). A result is good to a
// quarter of a metre and half a degree, from where matching converges. Views may agree at several
// poses (a row of houses, of parked cars), so a few are given, best first, and matching decides.
// Views must be in axes whose z is up to about 10 deg.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lio/relocalization/birds_eye_view.hpp"

namespace lio {

// Holds the pose of the later view in the axes of the earlier one, in which a point p of the later
// view appears at R(turn) p + shift.
struct PlanarPose {
  Eigen::Vector2f shift_m = Eigen::Vector2f::Zero();
  float turn_rad = 0.f;
};

// Holds the range of a search, to each side of its middle.
struct PlanarRange {
  Eigen::Vector2f shift_m = Eigen::Vector2f::Zero();
  float turn_rad = 0.f;
};

// Returns at most twelve poses; none where a view has too few structures.
[[nodiscard]] std::vector<PlanarPose> FindPlaces(const BirdsEyeView& earlier,
                                                 const BirdsEyeView& later,
                                                 const PlanarPose& middle,
                                                 const PlanarRange& range);

}  // namespace lio
