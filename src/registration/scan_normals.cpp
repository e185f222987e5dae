// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/scan_normals.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "lio/map/grazing_incidence.hpp"

namespace lio {
namespace {

VoxelCell CellAt(const Eigen::Vector3f& point, float inverse_voxel) {
  return {FloorToInt(point.x() * inverse_voxel), FloorToInt(point.y() * inverse_voxel),
          FloorToInt(point.z() * inverse_voxel)};
}

}  // namespace

void ScanNormals::Moments::Add(const Vector3& point) {
  count += 1.0;
  x += point.x();
  y += point.y();
  z += point.z();
  xx += point.x() * point.x();
  xy += point.x() * point.y();
  xz += point.x() * point.z();
  yy += point.y() * point.y();
  yz += point.y() * point.z();
  zz += point.z() * point.z();
}

void ScanNormals::Moments::operator+=(const Moments& other) {
  count += other.count;
  x += other.x;
  y += other.y;
  z += other.z;
  xx += other.xx;
  xy += other.xy;
  xz += other.xz;
  yy += other.yy;
  yz += other.yz;
  zz += other.zz;
}

std::size_t ScanNormals::LevelOf(float range_m) const {
  std::size_t level = 0;
  while (level + 1 < kNumLevels && range_m > levels_[level].max_range_m) ++level;
  return level;
}

void ScanNormals::AddTo(Level& level, const Eigen::Vector3f& point) {
  const VoxelCell cell = CellAt(point, 1.f / level.voxel_m);
  const auto added = level.voxels.FindOrAdd(PackVoxel(cell[0], cell[1], cell[2]));
  level.voxels.Of<Moments>(added.voxel).Add(point.cast<double>());
}

void ScanNormals::SetScan(std::span<const Eigen::Vector3f> points) {
  auto voxel_m = static_cast<float>(options_.shape_voxel_m);
  for (Level& level : levels_) {
    level.voxel_m = voxel_m;
    level.max_range_m = voxel_m / static_cast<float>(options_.shape_voxel_rad);
    level.voxels.Clear();
    voxel_m *= 2.f;
  }
  for (const Eigen::Vector3f& point : points) {
    const float range = point.norm();
    const std::size_t at = LevelOf(range);
    AddTo(levels_[at], point);
    const float overlap = ScanNormalParameters::kOverlap_voxels * levels_[at].voxel_m;
    if (at + 1 < kNumLevels && range + overlap > levels_[at].max_range_m) {
      AddTo(levels_[at + 1], point);
    }
    if (at > 0 && range - overlap < levels_[at - 1].max_range_m) AddTo(levels_[at - 1], point);
  }
}

PointWithNormal ScanNormals::At(const Eigen::Vector3f& point) const {
  PointWithNormal result;
  result.position = point;
  const Level& level = levels_[LevelOf(point.norm())];
  Moments around;
  const VoxelCell centre = CellAt(point, 1.f / level.voxel_m);
  const auto add = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    const std::int32_t voxel = level.voxels.Find(PackVoxel(x, y, z));
    if (voxel != VoxelIndex::kNone) around += level.voxels.Of<Moments>(voxel);
  };
  ForEachVoxel({centre[0] - 1, centre[1] - 1, centre[2] - 1},
               {centre[0] + 1, centre[1] + 1, centre[2] + 1}, add);
  FitNormal(around, level.voxel_m, result);
  return result;
}

void ScanNormals::FitNormal(const Moments& around, float voxel_m, PointWithNormal& result) const {
  if (around.count < ScanNormalParameters::kMinPoints) return;
  const Vector3 mean = Vector3(around.x, around.y, around.z) / around.count;
  Matrix3 cov;
  cov << around.xx, around.xy, around.xz, around.xy, around.yy, around.yz, around.xz, around.yz,
      around.zz;
  cov = cov / around.count - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Matrix3> eigen;
  eigen.computeDirect(cov);
  const Vector3 variance = eigen.eigenvalues();  // ascending
  const double min_width = ScanNormalParameters::kMinWidthPerVoxel * voxel_m;
  if (variance[1] < min_width * min_width) return;
  if (variance[0] > ScanNormalParameters::kMaxThicknessRatio * variance[1]) return;
  const double thickness_var =
      std::max(variance[0], options_.surface_std_m * options_.surface_std_m);
  const double normal_var = thickness_var / (around.count * variance[1]);
  if (normal_var >
      ScanNormalParameters::kMaxNormalStd_rad * ScanNormalParameters::kMaxNormalStd_rad) {
    return;
  }
  const Eigen::Vector3f normal = eigen.eigenvectors().col(0).cast<float>();
  if (IsGrazing(normal, result.position)) return;
  result.normal = normal;
  result.thickness_var = static_cast<float>(thickness_var);
  result.normal_var = static_cast<float>(normal_var);
  result.bend_var =
      static_cast<float>(ScanNormalParameters::kBend * thickness_var / (variance[1] * variance[1]));
}

}  // namespace lio
