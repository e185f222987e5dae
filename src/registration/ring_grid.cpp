// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/ring_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lio {
namespace {

constexpr int kMaxRingGap = LoamScanParameters::kMaxRingGap;

std::int32_t Cell(float coordinate) {
  return FloorToInt(coordinate);  // voxels of one metre
}

}  // namespace

void RingGrid::Clear() {
  voxels_.Clear();
  points_.clear();
}

void RingGrid::Add(const Eigen::Vector3f& point, std::uint16_t ring) {
  const auto added = voxels_.FindOrAdd(PackVoxel(
      Cell(point.x() / kVoxel_m), Cell(point.y() / kVoxel_m), Cell(point.z() / kVoxel_m)));
  std::int32_t& first = voxels_.Of<Chain>(added.voxel).first;
  points_.push_back({point, first, ring});
  first = static_cast<std::int32_t>(points_.size()) - 1;
}

template <class Visit>
void RingGrid::ForEachNear(const Eigen::Vector3f& query, float radius_m, const Visit& visit) const {
  const auto cells_at = [&](float offset_m) {
    const auto along = [&](float v) { return Cell((v + offset_m) / kVoxel_m); };
    return VoxelCell{along(query.x()), along(query.y()), along(query.z())};
  };
  ForEachVoxel(cells_at(-radius_m), cells_at(radius_m), [&](auto x, auto y, auto z) {
    const std::int32_t voxel = voxels_.Find(PackVoxel(x, y, z));
    if (voxel == VoxelIndex::kNone) return;
    std::int32_t i = voxels_.Of<Chain>(voxel).first;
    for (; i >= 0; i = points_[static_cast<std::size_t>(i)].next) {
      visit(i, voxel, points_[static_cast<std::size_t>(i)]);
    }
  });
}

RingGrid::Found RingGrid::Search(const Eigen::Vector3f& query, float radius_m,
                                 const Apart& apart) const {
  Found found;
  float best_sq = radius_m * radius_m;
  ForEachNear(query, radius_m, [&](std::int32_t i, std::int32_t voxel, const Point& point) {
    const float distance_sq = (point.position - query).squaredNorm();
    if (distance_sq >= best_sq) return;
    best_sq = distance_sq;
    found.nearest = i;
    found.part = voxel;
  });
  if (found.nearest < 0) return found;
  const Point& nearest = points_[static_cast<std::size_t>(found.nearest)];
  const auto limit_sq_on = [&](int gap) {
    const float limit = radius_m + apart.On(gap);
    return limit * limit;
  };
  float same_sq = limit_sq_on(0);
  float other_sq = limit_sq_on(1);
  ForEachNear(query, radius_m + std::max(apart.same_ring_m, apart.other_ring_m),
              [&](std::int32_t i, std::int32_t, const Point& point) {
                const int gap = std::abs(point.ring - nearest.ring);
                if (gap > kMaxRingGap || i == found.nearest) return;
                const float apart_sq = (point.position - nearest.position).squaredNorm();
                if (apart_sq < apart.On(gap) * apart.On(gap)) return;
                const float distance_sq = (point.position - query).squaredNorm();
                float& limit_sq = gap == 0 ? same_sq : other_sq;
                if (distance_sq >= limit_sq) return;
                limit_sq = distance_sq;
                (gap == 0 ? found.same_ring : found.other_ring) = i;
              });
  return found;
}

}  // namespace lio
