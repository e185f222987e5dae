// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/map_cloud.hpp"

#include <fmt/format.h>

#include <utility>

namespace lio {

void MapCloud::AddPoint(const Vector3& point) {
  const Eigen::Vector3f voxel = (point / voxel_m_).cast<float>();
  const float limit = static_cast<float>(kVoxelCoordinateLimit);
  if (!(voxel.cwiseAbs().maxCoeff() < limit)) return;  // more than 200 km away, or NaN
  const VoxelKey key =
      PackVoxel(FloorToInt(voxel.x()), FloorToInt(voxel.y()), FloorToInt(voxel.z()));
  if (voxels_.Insert(key)) points_map_.push_back(point.cast<float>());
}

void MapCloud::Add(std::span<const Eigen::Vector3f> points_imu, const Pose& T_map_imu) {
  const Matrix3 rotation = T_map_imu.rotation.toRotationMatrix();
  for (const Eigen::Vector3f& point_imu : points_imu) {
    AddPoint(rotation * point_imu.cast<double>() + T_map_imu.translation);
    if (points_map_.size() > max_points_) Coarsen();
  }
}

void MapCloud::Coarsen() {
  constexpr double kMaxVoxel_m = 1e4;  // points of nowhere near each other may need that
  while (points_map_.size() > max_points_ && voxel_m_ < kMaxVoxel_m) {
    voxel_m_ *= 2.0;
    voxels_ = {};
    for (const Eigen::Vector3f& point : std::exchange(points_map_, {})) {
      AddPoint(point.cast<double>());
    }
  }
  if (points_map_.size() > max_points_) points_map_.resize(max_points_);
}

std::string MapCloud::thinned() const {
  if (voxel_m_ == kVoxel_m) return {};
  return fmt::format("the map's file has {} million points: from here on one for each {:.1f} m",
                     max_points_ / 1'000'000, voxel_m_);
}

void MapCloud::Clear() {
  points_map_ = {};
  voxels_ = {};
  voxel_m_ = kVoxel_m;
}

}  // namespace lio
