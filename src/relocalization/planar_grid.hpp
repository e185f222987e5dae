// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Lays structures seen from above over a grid of planar poses around a middle.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "lio/relocalization/place_search.hpp"

namespace lio {

struct PlanarGrid {
  PlanarPose middle;
  // The grid has so many steps to each side of the middle.
  int num_x = 0;
  int num_y = 0;
  int num_turns = 0;
  float step_m = 0.f;
  float step_rad = 0.f;
};

// Calls `visit(turned, pose)` for each pose of the grid, in the order of turn, y and x; `turned`
// are the structures turned by the pose about their origin, but not shifted.
template <class Visit>
void ForEachPose(const std::vector<Eigen::Vector2f>& structures, const PlanarGrid& grid,
                 const Visit& visit) {
  std::vector<Eigen::Vector2f> turned(structures.size());
  for (int k = -grid.num_turns; k <= grid.num_turns; ++k) {
    const float turn_rad = grid.middle.turn_rad + static_cast<float>(k) * grid.step_rad;
    const Eigen::Matrix2f turn = Eigen::Rotation2Df(turn_rad).toRotationMatrix();
    std::transform(structures.begin(), structures.end(), turned.begin(),
                   [&](const Eigen::Vector2f& structure) { return turn * structure; });
    for (int y = -grid.num_y; y <= grid.num_y; ++y) {
      for (int x = -grid.num_x; x <= grid.num_x; ++x) {
        const Eigen::Vector2f steps(static_cast<float>(x), static_cast<float>(y));
        visit(turned, PlanarPose{grid.middle.shift_m + grid.step_m * steps, turn_rad});
      }
    }
  }
}

}  // namespace lio
