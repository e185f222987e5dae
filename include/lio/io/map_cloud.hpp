// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Collects the points of map.pcd: the first point in each voxel among all scans that were inserted
// into the map.
#pragma once

#include <Eigen/Core>
#include <span>
#include <unordered_set>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/base/voxel_key.hpp"

namespace lio {

class MapCloud {
 public:
  static constexpr double kVoxel_m = 0.2;
  static constexpr std::size_t kMaxPoints = 20'000'000;  // 1 GB with the table of voxels

  void Add(std::span<const Eigen::Vector3f> points_imu, const Pose& T_map_imu);
  void Clear();

  [[nodiscard]] const std::vector<Eigen::Vector3f>& points_map() const { return points_map_; }

 private:
  std::vector<Eigen::Vector3f> points_map_;
  std::unordered_set<VoxelKey> voxels_;
};

}  // namespace lio
