// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Collects the points of map.pcd: the first point in each voxel among all scans that were inserted
// into the map. Voxels are smaller where the place is narrow, as the cells of the local map are, so
// that a run can start in the map there. Memory is bounded: when so many points have come together
// that a further one would be too many, voxels become twice as wide, and the points are thinned
// anew.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/base/voxel_key.hpp"
#include "lio/base/voxel_set.hpp"
#include "lio/map/place_width.hpp"

namespace lio {

class MapCloud {
 public:
  // Chosen: fine enough to see cars and trees, and a tenth of the points of the scans.
  static constexpr double kVoxel_m = 0.2;
  // In narrow places. Measured: the place in a map of an office is found from voxels of 0.05 m on,
  // not from 0.1 m (docs/experiments/start_in_a_map.md).
  static constexpr double kNarrowVoxel_m = 0.05;
  // Chosen: half an hour of motorway, 0.4 GB with the table of voxels.
  static constexpr std::size_t kMaxPoints = 8'000'000;

  explicit MapCloud(std::size_t max_points = kMaxPoints) : max_points_(max_points) {}

  // Adds a scan. How wide the place is, it tells by itself and by the scans before.
  void Add(std::span<const Eigen::Vector3f> points_imu, const Pose& T_map_imu);
  // Adds the points of a saved map, as densely as they are down to kNarrowVoxel_m.
  void AddSaved(std::span<const Eigen::Vector3f> points_map);
  void Clear();

  [[nodiscard]] const std::vector<Eigen::Vector3f>& points_map() const { return points_map_; }
  // Returns the edge of voxels where the place is not narrow.
  [[nodiscard]] double voxel_m() const { return kVoxel_m * widening_; }
  // Says for users how the map was thinned; empty until it was.
  [[nodiscard]] std::string thinned() const;

 private:
  void AddPoint(const Vector3& point, bool is_dense);
  void Coarsen();

  std::size_t max_points_;
  double widening_ = 1.0;  // voxels of both kinds are so many times as wide
  std::vector<Eigen::Vector3f> points_map_;
  std::vector<bool> is_dense_;  // each point: it was thinned by small voxels
  VoxelSet voxels_;             // all points have one
  VoxelSet narrow_voxels_;      // dense points have one
  PlaceWidth width_;
};

}  // namespace lio
