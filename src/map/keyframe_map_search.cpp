// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Searches for the nearest point of the submap, shell by shell around the query.
#include <algorithm>
#include <bit>
#include <cmath>

#include "lio/map/keyframe_map.hpp"
#include "lio/map/map_parameters.hpp"

namespace lio {

struct KeyframeMap::Search {
  Vector3 query;
  VoxelCell voxel;
  // Holds the squared distance from the query to the voxels `offset` away along an axis [m^2].
  std::array<std::array<float, 2 * KeyframeMapParameters::kMaxSearch_voxels + 1>, 3> gap_sq;
  float best_sq;
  Hit best;
};

void KeyframeMap::SearchVoxel(const Blocks::Block& block, std::size_t voxel,
                              const Eigen::Vector3f& query, Search& search) const {
  for (std::int32_t at = block.voxels[voxel]; at != kNone; at = nodes_[ToIndex(at)].next) {
    const Node& node = nodes_[ToIndex(at)];
    std::array<float, kNodeSize> distance_sq;
    for (std::size_t i = 0; i < kNodeSize; ++i) {  // all of them: this becomes vector code
      const float dx = node.x[i] - query.x();
      const float dy = node.y[i] - query.y();
      const float dz = node.z[i] - query.z();
      distance_sq[i] = dx * dx + dy * dy + dz * dz;
    }
    for (std::size_t i = 0; i < ToIndex(node.count); ++i) {
      if (distance_sq[i] >= search.best_sq) continue;
      if (!keyframes_[ToIndex(node.keyframe[i])].is_chosen) continue;
      search.best_sq = distance_sq[i];
      search.best.point = node.point[i];
      search.best.from_query = Eigen::Vector3f(node.x[i], node.y[i], node.z[i]) - query;
    }
  }
}

// Visits all voxels within so many voxels of the query's own, block by block, each only when it can
// hold something nearer.
void KeyframeMap::SearchAround(Search& search, int radius_voxels) const {
  VoxelCell low, high;
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = search.voxel[i] - radius_voxels;
    high[i] = search.voxel[i] + radius_voxels;
  }
  const auto gap_sq = [&](std::size_t axis, std::int32_t voxel) {
    return search.gap_sq[axis][ToIndex(voxel - search.voxel[axis] +
                                       KeyframeMapParameters::kMaxSearch_voxels)];
  };
  const auto is_outside = [&](std::size_t axis, std::int32_t voxel) {
    return voxel < low[axis] || voxel > high[axis];
  };
  blocks_.ForEachBlock(low, high, [&](std::int32_t, const Blocks::Block& block) {
    const Eigen::Vector3f query = (search.query - blocks_.CornerOf(block)).cast<float>();
    for (std::uint64_t bits = block.occupied; bits != 0; bits &= bits - 1) {
      const int i = std::countr_zero(bits);
      const VoxelCell voxel{kBlockEdge * block.at[0] + (i & 3),
                            kBlockEdge * block.at[1] + (i >> 2 & 3),
                            kBlockEdge * block.at[2] + (i >> 4)};
      if (is_outside(0, voxel[0]) || is_outside(1, voxel[1]) || is_outside(2, voxel[2])) continue;
      if (gap_sq(0, voxel[0]) + gap_sq(1, voxel[1]) + gap_sq(2, voxel[2]) < search.best_sq) {
        SearchVoxel(block, ToIndex(i), query, search);
      }
    }
  });
}

KeyframeMap::Hit KeyframeMap::FindNearest(const Vector3& query_map, double radius_m,
                                          std::int32_t near) const {
  Search search{
      query_map, blocks_.VoxelAt(query_map), {}, static_cast<float>(radius_m * radius_m), {}};
  if (!blocks_.IsInRange(search.voxel)) return search.best;
  if (near != kNone) {
    const Point& point = points_[ToIndex(near)];
    const Vector3 local = query_map - blocks_.CornerOf(blocks_.block(point.block));
    const Eigen::Vector3f from_query = point.value.position - local.cast<float>();
    if (from_query.squaredNorm() < search.best_sq) {
      search.best_sq = from_query.squaredNorm();
      search.best = {near, from_query};
    }
  }
  double nearest_side = 1.0;  // distance to the nearest side of the query's voxel, in voxels
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double at =
        blocks_.Scaled(query_map[static_cast<Eigen::Index>(axis)]) - search.voxel[axis];
    nearest_side = std::min({nearest_side, at, 1.0 - at});
    for (int offset = -KeyframeMapParameters::kMaxSearch_voxels;
         offset <= KeyframeMapParameters::kMaxSearch_voxels; ++offset) {
      const double gap = offset > 0 ? offset - at : (offset < 0 ? at - offset - 1.0 : 0.0);
      search.gap_sq[axis][ToIndex(offset + KeyframeMapParameters::kMaxSearch_voxels)] =
          static_cast<float>(gap * gap * options_.voxel_m * options_.voxel_m);
    }
  }
  const int radius_voxels = std::min(static_cast<int>(std::ceil(blocks_.Scaled(radius_m))),
                                     KeyframeMapParameters::kMaxSearch_voxels);
  for (const int shells : {0, 1, radius_voxels}) {  // a near hit makes the rest of the search short
    SearchAround(search, std::min(shells, radius_voxels));
    const double searched_m = options_.voxel_m * (shells + nearest_side);
    if (searched_m > 0.0 && search.best_sq <= searched_m * searched_m) break;
  }
  return search.best;
}

}  // namespace lio
