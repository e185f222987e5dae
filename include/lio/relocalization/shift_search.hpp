// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// How far the sensor has gone since a few earlier scans, where surfaces do not tell: along an open
// road posts, trees and cars do, and all of them are laid over those of the earlier views at once.
// How well each place fits is taken for how likely it is, so the covariance says whether one place
// stands out, or a stretch of road looks the same. Good to about 0.2 m. Views are of the same axes,
// whose z is up to about 10 deg. After Olson, "Real-Time Correlative Scan Matching", ICRA 2009.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "lio/relocalization/birds_eye_view.hpp"

namespace lio {

struct PlacedView {
  Eigen::Vector2f position_m;  // of the sensor, in axes that all share
  BirdsEyeView view;
};

struct FoundShift {
  Eigen::Vector2d position_m;
  Eigen::Matrix2d cov;  // m^2
};

// Where `now` was seen from, sought up to `range_m` around `guess_m` in x and y. Absent where too
// little stands, and where the views are as alike unshifted: along plain walls a sensor sees its
// own rings, which move with it, and at rest there is nothing to seek; and where the best
// place is at the border of what was looked at.
std::optional<FoundShift> FindShift(std::span<const PlacedView> earlier, const BirdsEyeView& now,
                                    const Eigen::Vector2f& guess_m, float range_m);

}  // namespace lio
