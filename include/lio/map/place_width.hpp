// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Is the place so narrow, or so little of it seen, that the map's largest cells are too few to tell
// the pose? A lidar that looks at a wall from a metre sees some square metres of it.
#pragma once

#include <span>

#include "lio/base/rotation.hpp"
#include "lio/map/low_mean.hpp"

namespace lio {

class PlaceWidth {
 public:
  // Adds a scan: it counts how many cells of `edge_m` its points lie in. One of few points tells
  // nothing: many points in few cells make a place narrow.
  void Add(std::span<const Eigen::Vector3f> points_imu, double edge_m);
  // Nothing was added yet.
  [[nodiscard]] bool is_unknown() const { return mean_cells_.is_unknown(); }
  [[nodiscard]] bool is_narrow() const { return mean_cells_.is_low(); }

 private:
  LowMean mean_cells_;
};

}  // namespace lio
