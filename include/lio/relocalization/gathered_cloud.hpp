// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gathers the points of the scans so far, in the new map that they make, thinned: what is looked
// for in a map saved before. It shows more of the place than one scan does, and from several
// viewpoints.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/base/voxel_set.hpp"

namespace lio {

// Holds the cloud around the body at one instant, in the axes of its map.
struct CloudSample {
  Vector3 centre_map = Vector3::Zero();     // the body's position
  std::vector<Eigen::Vector2f> structures;  // things that stand up, seen from above
  std::vector<Eigen::Vector3f> points;      // evenly chosen; from the centre
};

class GatheredCloud {
 public:
  void Add(std::span<const Eigen::Vector3f> points_imu, const Pose& T_map_imu);
  [[nodiscard]] CloudSample SampleAround(const Vector3& centre_map) const;

 private:
  VoxelSet voxels_;
  std::vector<Eigen::Vector3f> points_map_;
};

}  // namespace lio
