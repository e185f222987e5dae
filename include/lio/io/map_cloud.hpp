// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Collects the points of map.pcd: the first point in each voxel among all scans that were inserted
// into the map. Its memory is bounded: when so many points have come together that a further one
// would be too many, voxels become twice as wide, and the points are thinned anew.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/base/voxel_key.hpp"
#include "lio/base/voxel_set.hpp"

namespace lio {

class MapCloud {
 public:
  // Chosen: fine enough to see cars and trees, and a tenth of the points of the scans.
  static constexpr double kVoxel_m = 0.2;
  // Chosen: half an hour of motorway, 0.4 GB with the table of voxels.
  static constexpr std::size_t kMaxPoints = 8'000'000;

  explicit MapCloud(std::size_t max_points = kMaxPoints) : max_points_(max_points) {}

  void Add(std::span<const Eigen::Vector3f> points_imu, const Pose& T_map_imu);
  void Clear();

  [[nodiscard]] const std::vector<Eigen::Vector3f>& points_map() const { return points_map_; }
  [[nodiscard]] double voxel_m() const { return voxel_m_; }
  // Says for users how the map was thinned; empty until it was.
  [[nodiscard]] std::string thinned() const;

 private:
  void AddPoint(const Vector3& point);
  void Coarsen();

  std::size_t max_points_;
  double voxel_m_ = kVoxel_m;
  std::vector<Eigen::Vector3f> points_map_;
  VoxelSet voxels_;
};

}  // namespace lio
