// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/gathered_cloud.hpp"

#include "lio/base/voxel_key.hpp"
#include "lio/relocalization/birds_eye_view.hpp"
#include "lio/relocalization/parameters.hpp"
#include "relocalization/standing_points.hpp"

namespace lio {
namespace {

constexpr GatheredCloudParameters kGathered = kRelocalization.gathered;

}  // namespace

void GatheredCloud::Add(std::span<const Eigen::Vector3f> points_imu, const Pose& T_map_imu) {
  if (points_map_.size() > kGathered.max_points) *this = {};
  const Eigen::Matrix3f rotation = T_map_imu.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f translation = T_map_imu.translation.cast<float>();
  for (const Eigen::Vector3f& point_imu : points_imu) {
    const Eigen::Vector3f point = rotation * point_imu + translation;
    const VoxelCell voxel = VoxelOf((point / kGathered.thin_m).cast<double>());
    if (voxels_.Insert(PackVoxel(voxel[0], voxel[1], voxel[2]))) points_map_.push_back(point);
  }
}

CloudSample GatheredCloud::SampleAround(const Vector3& centre_map) const {
  const Eigen::Vector3f centre = centre_map.cast<float>();
  std::vector<Eigen::Vector3f> near;
  for (const Eigen::Vector3f& point : points_map_) {
    const Eigen::Vector2f off = (point - centre).head<2>();
    if (off.norm() < kGathered.max_range_m) near.push_back(point);
  }
  CloudSample sample;
  sample.centre_map = centre_map;
  sample.structures =
      SpreadEvenly(ColumnMeans(StandingPoints(near)), MapSearchParameters::kFromAbove.max_num);
  const std::size_t num = std::min(near.size(), kGathered.max_sample);
  for (std::size_t i = 0; i < num; ++i) {
    sample.points.emplace_back(near[i * near.size() / num] - centre);
  }
  return sample;
}

}  // namespace lio
