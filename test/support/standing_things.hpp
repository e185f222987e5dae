// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes scans of bare ground and of things that stand on it, for tests of bird's-eye views.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <vector>

#include "lio/base/pose.hpp"

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

// Adds a column 0.3 m wide as many scans see it: on its edges a point every 0.1 m.
inline void AddColumn(const Eigen::Vector2f& place, Points& points) {
  for (int i = 0; i < 30; ++i) {
    for (const Eigen::Vector2f& edge :
         {Eigen::Vector2f(-0.15f, -0.15f), Eigen::Vector2f(0.15f, -0.15f),
          Eigen::Vector2f(-0.15f, 0.15f), Eigen::Vector2f(0.15f, 0.15f)}) {
      const Eigen::Vector2f at = place + edge;
      points.emplace_back(at.x(), at.y(), -1.8f + 0.1f * static_cast<float>(i));
    }
  }
}

// Returns posts at random places, as a body at the pose sees them.
inline Points PostsSeenFrom(const Pose& T_map_imu) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> coordinate(-50.0, 50.0);
  Points points;
  for (int i = 0; i < 80; ++i) {
    const double x = coordinate(random);
    const double y = coordinate(random);
    for (double z = -1.8; z < 0.6; z += 0.3) {
      points.push_back((T_map_imu.Inverse() * Vector3(x, y, z)).cast<float>());
    }
  }
  return points;
}

}  // namespace lio::test
