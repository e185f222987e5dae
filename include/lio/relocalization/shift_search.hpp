// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds the sensor's position relative to a few earlier scans in directions that surfaces leave
// degenerate: along an open road posts, trees and cars tell it. The view is laid over all earlier
// views at once, at every shift in a range; the score of a shift is taken for its log-likelihood,
// so that the covariance says whether one position stands out or a length of road looks the same.
// It is good to about 0.2 m. All views are in the same axes, whose z is up to about 10 deg. After
// E. Olson, "Real-Time Correlative Scan Matching", ICRA 2009.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "lio/relocalization/birds_eye_view.hpp"

namespace lio {

struct PlacedView {
  Eigen::Vector2f position_m;  // the sensor's, in axes that all share
  BirdsEyeView view;
};

struct FoundShift {
  Eigen::Vector2d position_m;
  Eigen::Matrix2d cov;  // m^2
};

// Returns the position that `now` was seen from, searched up to `range_m` around `guess_m` in x and
// y. The result is absent where there are too few structures; where the views agree as well
// unshifted (along plain walls a sensor sees its own rings, which move with it, and at rest there
// is nothing to find); and where the best position is at the border of the range.
[[nodiscard]] std::optional<FoundShift> FindShift(std::span<const PlacedView> earlier,
                                                  const BirdsEyeView& now,
                                                  const Eigen::Vector2f& guess_m, float range_m);

}  // namespace lio
