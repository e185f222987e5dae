// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds the things that stand up in a cloud of many scans (walls, posts, trees), seen from above.
// Unlike a BirdsEyeView this needs no viewpoint and may have a ceiling: a thing stands where the
// points of a voxel of one metre spread over its height, which neither a floor nor a ceiling does.
// Points are in metres, in axes whose z is up to about 10 deg.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace lio {

// Returns the points on things that stand up, seen from above, in their order.
[[nodiscard]] std::vector<Eigen::Vector2f> StandingPoints(std::span<const Eigen::Vector3f> points);

// Returns the mean of the points of each column of half a metre, in the order of the columns' first
// points.
[[nodiscard]] std::vector<Eigen::Vector2f> ColumnMeans(std::span<const Eigen::Vector2f> points);

}  // namespace lio
