// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds the convex hull of places in a plane.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace lio {

// Gives the indices of the hull's corners, against the clock from the leftmost one; places on its
// sides are none. Fewer than three places are all corners. The method is Andrew's monotone chain
// (Inf. Process. Lett. 9, 1979).
[[nodiscard]] std::vector<std::size_t> ConvexHull(const std::vector<Eigen::Vector2d>& places);

}  // namespace lio
