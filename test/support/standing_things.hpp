// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes scans of bare ground and of things that stand on it, for tests of bird's-eye views.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace lio::test {

using Points = std::vector<Eigen::Vector3f>;

// Adds rings on the ground, which are the same wherever the sensor is.
inline void AddRings(Points& points) {
  for (const float radius : {4.f, 5.f, 6.5f, 9.f, 14.f, 25.f}) {
    for (int i = 0; i < 360; ++i) {
      const float angle = static_cast<float>(i) * 0.0174533f;
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), -1.8f);
    }
  }
}

// Adds a post as the beams of a sensor at `sensor` see it.
inline void AddPost(const Eigen::Vector2f& place, const Eigen::Vector2f& sensor, Points& points) {
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector2f seen = place - sensor;
    points.emplace_back(seen.x(), seen.y(), -1.8f + 0.3f * static_cast<float>(i));
  }
}

}  // namespace lio::test
