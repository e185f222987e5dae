// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds a point with the plane that was fitted to its surroundings.
#pragma once

#include <Eigen/Core>

namespace lio {

struct PointWithNormal {
  Eigen::Vector3f position;                          // m
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // unit, either side; zero: rank-deficient
  float thickness_var = 0.f;                         // along the normal [m^2]
  float normal_var = 0.f;                            // variance of the normal's tilt [rad^2]
  // The surface's distance from its plane varies by this at one metre [m^2]; at another distance it
  // goes with the distance's fourth power.
  float bend_var = 0.f;

  // Returns false where the surroundings are rank-deficient: too few points, or on a line.
  [[nodiscard]] bool HasNormal() const { return thickness_var > 0.f; }
};

}  // namespace lio
