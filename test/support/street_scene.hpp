// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes places to match scans in, from the parts in test/support/ray_scene.hpp. The ground is at z
// = 0; the sensor is at z = 1.8 m.
#pragma once

#include <random>

#include "support/ray_scene.hpp"

namespace lio::test {

// Makes a street along x: houses with gaps on both sides, parked cars, poles, and the end of a side
// street.
inline RayScene StreetScene(unsigned seed = 1) {
  RayScene scene;
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  scene.AddGround(0.0);
  for (const double side : {-1.0, 1.0}) {
    double x = -60.0;
    while (x < 60.0) {
      const double length = uniform(6.0, 14.0);
      const double depth = uniform(4.0, 8.0);
      const double setback = uniform(8.0, 11.0);
      const double height = uniform(6.0, 14.0);
      scene.Add(RayBox{{x + 0.5 * length, side * (setback + 0.5 * depth), 0.5 * height},
                       {0.5 * length, 0.5 * depth, 0.5 * height},
                       uniform(-0.06, 0.06)});
      x += length + (uniform(0, 1) < 0.4 ? uniform(2.0, 5.0) : 0.3);
    }
    for (double at = -50.0; at < 50.0; at += uniform(8.0, 16.0)) {
      scene.Add(RayBox{{at, side * uniform(4.6, 5.2), 0.7}, {2.1, 0.85, 0.7}, uniform(-0.1, 0.1)});
      scene.Add(Cylinder{{at + 4.5, side * uniform(6.2, 6.8), 0}, uniform(0.1, 0.2), 7.0});
    }
  }
  return scene;
}

// Makes a straight corridor along x, longer than the sensor's range: the x direction is not
// observable.
inline RayScene CorridorScene() {
  RayScene scene;
  scene.AddGround(0.0);
  scene.Add(RayBox{{0, 3.3, 3}, {500, 0.3, 3}, 0});
  scene.Add(RayBox{{0, -3.3, 3}, {500, 0.3, 3}, 0});
  scene.Add(RayBox{{0, 0, 4.2}, {500, 4, 0.2}, 0});
  return scene;
}

inline Pose SensorAt(double x, double y, double yaw_rad = 0.0, double pitch_rad = 0.0,
                     double roll_rad = 0.0) {
  const Quaternion turn = ExpSo3(Vector3(0, 0, yaw_rad)) * ExpSo3(Vector3(0, pitch_rad, 0)) *
                          ExpSo3(Vector3(roll_rad, 0, 0));
  return {turn, Vector3(x, y, 1.8)};
}

}  // namespace lio::test
