// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Simulates a spinning lidar at rest in a round room, point by point with exact times, and the
// clouds that drivers would make of it.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "support/ros_bag.hpp"

namespace lio::test {

struct SpinningLidar {
  int num_rings = 16;
  int num_columns = 360;          // columns of one cloud
  double columns_per_turn = 356;  // if less than num_columns, a cloud overlaps itself
  double turn_s = 0.1;
  double first_azimuth_deg = -37.0;     // azimuth of the first cloud
  double direction = -1.0;              // clockwise
  double firing_s = 2e-6;               // from one beam to the next
  std::vector<double> offset_deg = {};  // azimuth offset of each ring; empty: none

  double lowest_deg = -15.0;
  double spacing_deg = 2.0;
};

struct SeenPoint {
  double x = 0, y = 0, z = 0;
  int ring = 0;  // 0 is the lowest
  int column = 0;
  double time_s = 0;  // since the first point of the cloud
};

inline double CloudSeconds(const SpinningLidar& lidar) {
  return lidar.num_columns * lidar.turn_s / lidar.columns_per_turn;
}

// Returns the points of cloud `k` in the order of firing.
inline std::vector<SeenPoint> SeePoints(const SpinningLidar& lidar, int k) {
  std::vector<SeenPoint> points;
  const double begin_s = k * CloudSeconds(lidar);
  const double rate = lidar.direction * 2.0 * std::numbers::pi / lidar.turn_s;
  for (int column = 0; column < lidar.num_columns; ++column) {
    for (int ring = 0; ring < lidar.num_rings; ++ring) {
      const double degree = std::numbers::pi / 180.0;
      SeenPoint point;
      point.ring = ring;
      point.column = column;
      point.time_s = column * lidar.turn_s / lidar.columns_per_turn + ring * lidar.firing_s;
      const double offset =
          lidar.offset_deg.empty() ? 0.0 : lidar.offset_deg[static_cast<std::size_t>(ring)];
      const double azimuth =
          (lidar.first_azimuth_deg + offset) * degree + rate * (begin_s + point.time_s);
      const double elevation = (lidar.lowest_deg + ring * lidar.spacing_deg) * degree;
      const double range = 8.0 + 2.0 * std::cos(3.0 * azimuth);
      point.x = range * std::cos(elevation) * std::cos(azimuth);
      point.y = range * std::cos(elevation) * std::sin(azimuth);
      point.z = range * std::sin(elevation);
      points.push_back(point);
    }
  }
  return points;
}

inline CloudField Field(std::string name, std::uint32_t offset, FieldType type) {
  return {std::move(name), offset, type};
}

// Stores x, y, z and, if the cloud has such fields, "intensity" (the ring) and "ring".
inline void StorePoint(TestCloud& cloud, std::size_t i, const SeenPoint& point) {
  cloud.Set(i, "x", point.x);
  cloud.Set(i, "y", point.y);
  cloud.Set(i, "z", point.z);
  cloud.Set(i, "intensity", 10.0 + point.ring);
  cloud.Set(i, "ring", point.ring);
}

// Makes a cloud in the layout of Velodyne's driver: 22 bytes, time in float seconds.
inline TestCloud VelodyneCloud(Timestamp stamp, const std::vector<SeenPoint>& points) {
  TestCloud cloud;
  cloud.stamp = stamp;
  cloud.point_step = 22;
  cloud.fields = {
      Field("x", 0, FieldType::kFloat32),    Field("y", 4, FieldType::kFloat32),
      Field("z", 8, FieldType::kFloat32),    Field("intensity", 12, FieldType::kFloat32),
      Field("ring", 16, FieldType::kUint16), Field("time", 18, FieldType::kFloat32)};
  cloud.Resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    StorePoint(cloud, i, points[i]);
    cloud.Set(i, "time", points[i].time_s);
  }
  return cloud;
}

}  // namespace lio::test
