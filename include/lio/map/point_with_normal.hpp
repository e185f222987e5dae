// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A point with the surface around it.
#pragma once

#include <Eigen/Core>

namespace lio {

struct PointWithNormal {
  Eigen::Vector3f position;                          // m
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // unit, either side; zero: shape unknown
  float thickness_var = 0.f;                         // along the normal [m^2]
  float normal_var = 0.f;                            // of the normal's tilt [rad^2]
  float bend_var = 0.f;  // of how far the surface bends away from its plane, at a metre [m^2]; at
                         // another distance times its fourth power

  bool HasNormal() const { return thickness_var > 0.f; }
};

}  // namespace lio
