// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/place_width.hpp"

#include "lio/base/voxel_set.hpp"
#include "lio/map/map_parameters.hpp"

namespace lio {
namespace {

double NumCells(std::span<const Eigen::Vector3f> points, double edge_m) {
  VoxelSet cells;
  for (const Eigen::Vector3f& point : points) {
    const Vector3 scaled = point.cast<double>() / edge_m;
    if (!IsVoxel(scaled)) continue;
    const VoxelCell cell = VoxelOf(scaled);
    cells.Insert(PackVoxel(cell[0], cell[1], cell[2]));
    if (cells.size() >= PlaceWidthParameters::kMaxCounted) break;
  }
  return static_cast<double>(cells.size());
}

}  // namespace

void PlaceWidth::Add(std::span<const Eigen::Vector3f> points_imu, double edge_m) {
  if (points_imu.size() < PlaceWidthParameters::kMaxCounted) return;
  mean_cells_.Add(NumCells(points_imu, edge_m), PlaceWidthParameters::kNarrowBelow,
                  PlaceWidthParameters::kWideAbove);
}

}  // namespace lio
