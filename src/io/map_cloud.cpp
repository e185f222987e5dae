// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/map_cloud.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "lio/map/ndt_options.hpp"

namespace lio {
namespace {

// Returns no key for a point that is more than 200 km away, or NaN.
std::optional<VoxelKey> KeyOf(const Vector3& point, double voxel_m) {
  const Eigen::Vector3f voxel = (point / voxel_m).cast<float>();
  const float limit = static_cast<float>(kVoxelCoordinateLimit);
  if (!(voxel.cwiseAbs().maxCoeff() < limit)) return {};
  return PackVoxel(FloorToInt(voxel.x()), FloorToInt(voxel.y()), FloorToInt(voxel.z()));
}

}  // namespace

// A dense point takes its large voxel, too, so that scans of a wide place add none beside it.
void MapCloud::AddPoint(const Vector3& point, bool is_dense) {
  const std::optional<VoxelKey> key = KeyOf(point, voxel_m());
  if (!key) return;
  bool is_new = voxels_.Insert(*key);
  if (is_dense) {
    const std::optional<VoxelKey> small = KeyOf(point, kNarrowVoxel_m * widening_);
    is_new = small && narrow_voxels_.Insert(*small);
  }
  if (!is_new) return;
  points_map_.push_back(point.cast<float>());
  is_dense_.push_back(is_dense);
}

void MapCloud::Add(std::span<const Eigen::Vector3f> points_imu, const Pose& T_map_imu) {
  width_.Add(points_imu, NdtOptions{}.voxel_m);
  const Matrix3 rotation = T_map_imu.rotation.toRotationMatrix();
  for (const Eigen::Vector3f& point_imu : points_imu) {
    AddPoint(rotation * point_imu.cast<double>() + T_map_imu.translation, width_.is_narrow());
    if (points_map_.size() > max_points_) Coarsen();
  }
}

void MapCloud::AddSaved(std::span<const Eigen::Vector3f> points_map) {
  for (const Eigen::Vector3f& point : points_map) {
    AddPoint(point.cast<double>(), true);
    if (points_map_.size() > max_points_) Coarsen();
  }
}

void MapCloud::Coarsen() {
  constexpr double kMaxWidening = 5e4;  // points of nowhere near each other may need that
  while (points_map_.size() > max_points_ && widening_ < kMaxWidening) {
    widening_ *= 2.0;
    voxels_ = {};
    narrow_voxels_ = {};
    const auto points = std::exchange(points_map_, {});
    const auto were_dense = std::exchange(is_dense_, {});
    for (std::size_t i = 0; i < points.size(); ++i) {
      AddPoint(points[i].cast<double>(), were_dense[i]);
    }
  }
  if (points_map_.size() > max_points_) {
    points_map_.resize(max_points_);
    is_dense_.resize(max_points_);
  }
}

std::string MapCloud::thinned() const {
  if (widening_ == 1.0) return {};
  return fmt::format("the map's file has {} million points: from here on one for each {:.1f} m",
                     max_points_ / 1'000'000, voxel_m());
}

void MapCloud::Clear() {
  *this = MapCloud(max_points_);
}

}  // namespace lio
