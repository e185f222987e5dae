// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/scan_normals.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "lio/base/rotation.hpp"
#include "lio/map/grazing_incidence.hpp"

namespace lio {
namespace {

VoxelCell CellAt(const Eigen::Vector3f& point, float inverse_voxel) {
  return {FloorToInt(point.x() * inverse_voxel), FloorToInt(point.y() * inverse_voxel),
          FloorToInt(point.z() * inverse_voxel)};
}

}  // namespace

std::size_t ScanNormals::LevelOf(float range_m) const {
  std::size_t level = 0;
  while (level + 1 < kNumLevels && range_m > levels_[level].max_range_m) ++level;
  return level;
}

void ScanNormals::AddTo(Level& level, const Eigen::Vector3f& point) {
  const VoxelCell cell = CellAt(point, 1.f / level.voxel_m);
  const auto added = level.voxels.FindOrAdd(PackVoxel(cell[0], cell[1], cell[2]));
  Moments& m = level.voxels.Of<Moments>(added.voxel);
  const Vector3 p = point.cast<double>();
  m.count += 1.0;
  m.x += p.x();
  m.y += p.y();
  m.z += p.z();
  m.xx += p.x() * p.x();
  m.xy += p.x() * p.y();
  m.xz += p.x() * p.z();
  m.yy += p.y() * p.y();
  m.yz += p.y() * p.z();
  m.zz += p.z() * p.z();
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
  Moments sum;
  const VoxelCell centre = CellAt(point, 1.f / level.voxel_m);
  const auto add = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    const std::int32_t voxel = level.voxels.Find(PackVoxel(x, y, z));
    if (voxel == VoxelIndex::kNone) return;
    const Moments& m = level.voxels.Of<Moments>(voxel);
    sum.count += m.count;
    sum.x += m.x;
    sum.y += m.y;
    sum.z += m.z;
    sum.xx += m.xx;
    sum.xy += m.xy;
    sum.xz += m.xz;
    sum.yy += m.yy;
    sum.yz += m.yz;
    sum.zz += m.zz;
  };
  ForEachVoxel({centre[0] - 1, centre[1] - 1, centre[2] - 1},
               {centre[0] + 1, centre[1] + 1, centre[2] + 1}, add);
  if (sum.count < ScanNormalParameters::kMinPoints) return result;
  const Vector3 mean = Vector3(sum.x, sum.y, sum.z) / sum.count;
  Matrix3 cov;
  cov << sum.xx, sum.xy, sum.xz, sum.xy, sum.yy, sum.yz, sum.xz, sum.yz, sum.zz;
  cov = cov / sum.count - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Matrix3> eigen;
  eigen.computeDirect(cov);
  const Vector3 variance = eigen.eigenvalues();  // ascending
  const double min_width = ScanNormalParameters::kMinWidthPerVoxel * level.voxel_m;
  if (variance[1] < min_width * min_width) return result;
  if (variance[0] > ScanNormalParameters::kMaxThicknessRatio * variance[1]) return result;
  const double thickness_var =
      std::max(variance[0], options_.surface_std_m * options_.surface_std_m);
  const double normal_var = thickness_var / (sum.count * variance[1]);
  if (normal_var >
      ScanNormalParameters::kMaxNormalStd_rad * ScanNormalParameters::kMaxNormalStd_rad) {
    return result;
  }
  const Eigen::Vector3f normal = eigen.eigenvectors().col(0).cast<float>();
  if (IsGrazing(normal, point)) return result;
  result.normal = normal;
  result.thickness_var = static_cast<float>(thickness_var);
  result.normal_var = static_cast<float>(normal_var);
  result.bend_var =
      static_cast<float>(ScanNormalParameters::kBend * thickness_var / (variance[1] * variance[1]));
  return result;
}

}  // namespace lio
