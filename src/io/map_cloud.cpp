// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/map_cloud.hpp"

namespace lio {

void MapCloud::Add(std::span<const Eigen::Vector3f> points_imu, const Pose& T_map_imu) {
  const Matrix3 rotation = T_map_imu.rotation.toRotationMatrix();
  for (const Eigen::Vector3f& point_imu : points_imu) {
    if (points_map_.size() >= kMaxPoints) return;
    const Vector3 point = rotation * point_imu.cast<double>() + T_map_imu.translation;
    const Eigen::Vector3f voxel = (point / kVoxel_m).cast<float>();
    const float limit = static_cast<float>(kVoxelCoordinateLimit);
    if (!(voxel.cwiseAbs().maxCoeff() < limit)) continue;  // more than 200 km away, or NaN
    const VoxelKey key =
        PackVoxel(FloorToInt(voxel.x()), FloorToInt(voxel.y()), FloorToInt(voxel.z()));
    if (voxels_.insert(key).second) points_map_.push_back(point.cast<float>());
  }
}

void MapCloud::Clear() {
  points_map_.clear();
  voxels_.clear();
}

}  // namespace lio
