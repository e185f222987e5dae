// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "relocalization/standing_points.hpp"

#include "lio/base/voxel_map.hpp"
#include "lio/relocalization/parameters.hpp"

namespace lio {
namespace {

constexpr StandingPointsParameters kStanding = kRelocalization.standing;

struct Heights {
  int num = 0;
  double sum = 0.0;
  double sum_sq = 0.0;  // both from the voxel's floor

  [[nodiscard]] bool IsStanding() const {
    if (num < kStanding.min_points) return false;
    const double mean = sum / num;
    return sum_sq / num - mean * mean > kStanding.min_std_m * kStanding.min_std_m;
  }
};

struct ColumnSum {
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  int num = 0;
};

VoxelKey KeyOf(const Eigen::Vector3f& point, float edge_m) {
  const VoxelCell voxel = VoxelOf((point / edge_m).cast<double>());
  return PackVoxel(voxel[0], voxel[1], voxel[2]);
}

}  // namespace

std::vector<Eigen::Vector2f> StandingPoints(std::span<const Eigen::Vector3f> points) {
  VoxelMap<Heights> voxels;
  std::vector<std::int32_t> voxel_of;
  voxel_of.reserve(points.size());
  for (const Eigen::Vector3f& point : points) {
    voxel_of.push_back(voxels.FindOrAdd(KeyOf(point, kStanding.voxel_m)).voxel);
    Heights& heights = voxels.Of<Heights>(voxel_of.back());
    const double height_m =
        point.z() - kStanding.voxel_m * std::floor(point.z() / kStanding.voxel_m);
    ++heights.num;
    heights.sum += height_m;
    heights.sum_sq += height_m * height_m;
  }
  std::vector<Eigen::Vector2f> standing;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (voxels.Of<Heights>(voxel_of[i]).IsStanding()) standing.push_back(points[i].head<2>());
  }
  return standing;
}

std::vector<Eigen::Vector2f> ColumnMeans(std::span<const Eigen::Vector2f> points) {
  VoxelMap<ColumnSum> columns;
  for (const Eigen::Vector2f& point : points) {
    const Eigen::Vector3f on_ground(point.x(), point.y(), 0.f);
    ColumnSum& column =
        columns.Of<ColumnSum>(columns.FindOrAdd(KeyOf(on_ground, kStanding.column_m)).voxel);
    column.sum += point;
    ++column.num;
  }
  std::vector<Eigen::Vector2f> means;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const ColumnSum& column = columns.Of<ColumnSum>(static_cast<std::int32_t>(i));
    means.push_back(column.sum / static_cast<float>(column.num));
  }
  return means;
}

}  // namespace lio
