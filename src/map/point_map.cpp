// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/point_map.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "lio/map/map_parameters.hpp"

namespace lio {
namespace {

// Voxels of a block with low <= coordinate <= high, along one axis, as a mask of its 64.
constexpr std::uint64_t AxisMask(int axis, int low, int high) {
  std::uint64_t mask = 0;
  for (int i = 0; i < 64; ++i) {
    const int coordinate = (i >> (2 * axis)) & 3;
    if (coordinate >= low && coordinate <= high) mask |= std::uint64_t{1} << i;
  }
  return mask;
}

struct AxisMasks {
  std::array<std::array<std::array<std::uint64_t, 4>, 4>, 3> of{};
  constexpr AxisMasks() {
    for (int axis = 0; axis < 3; ++axis) {
      for (int low = 0; low < 4; ++low) {
        for (int high = 0; high < 4; ++high) of[axis][low][high] = AxisMask(axis, low, high);
      }
    }
  }
};
constexpr AxisMasks kAxisMasks;

}  // namespace

struct PointMap::Search {
  Vector3 query;
  VoxelCell voxel;
  int wanted;
  float max_distance_sq;
  Neighbours found;

  void Offer(const Neighbour& neighbour) {
    if (neighbour.distance_sq > max_distance_sq) return;
    if (found.count == wanted) {
      if (neighbour.distance_sq >= found.list[static_cast<std::size_t>(wanted - 1)].distance_sq) {
        return;
      }
    } else {
      ++found.count;
    }
    auto at = static_cast<std::size_t>(found.count - 1);
    for (; at > 0 && found.list[at - 1].distance_sq > neighbour.distance_sq; --at) {
      found.list[at] = found.list[at - 1];
    }
    found.list[at] = neighbour;
  }
};

PointMap::PointMap(const PointMapOptions& options)
    : options_(options), blocks_(options.voxel_m, PointMapParameters::kMaxSearch_voxels) {
  if (!(options.voxel_m > 0) || options.max_voxel_points < 1 || options.max_voxels < 1 ||
      !(options.max_distance_m > 0)) {
    throw std::invalid_argument("PointMap: an option is out of range");
  }
}

// Visits all voxels within so many voxels of the query's own, block by block.
void PointMap::SearchAround(Search& search, int radius_voxels) const {
  search.found.count = 0;
  VoxelCell low, high;
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = search.voxel[i] - radius_voxels;
    high[i] = search.voxel[i] + radius_voxels;
  }
  const auto mask_along = [&](std::size_t axis, std::int32_t block) {
    const std::int32_t corner = block * kBlockEdge;
    return kAxisMasks.of[axis][ToIndex(std::max(low[axis] - corner, 0))]
                        [ToIndex(std::min(high[axis] - corner, kBlockEdge - 1))];
  };
  blocks_.ForEachBlock(low, high, [&](std::int32_t number, const Blocks::Block& block) {
    const Eigen::Vector3f query = (search.query - blocks_.CornerOf(block)).cast<float>();
    const std::uint64_t mask =
        mask_along(0, block.at[0]) & mask_along(1, block.at[1]) & mask_along(2, block.at[2]);
    for (std::uint64_t bits = block.occupied & mask; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(bits));
      const Eigen::Vector3f from_query = block.voxels[i].head<3>() - query;
      search.Offer({from_query, from_query.squaredNorm(), block.voxels[i].w(), number});
    }
  });
}

PointMap::Neighbours PointMap::FindNearest(const Vector3& query_map, int wanted,
                                           double radius_m) const {
  Search search{query_map,
                blocks_.VoxelAt(query_map),
                std::min(wanted, kMaxNeighbours),
                static_cast<float>(radius_m * radius_m),
                {}};
  if (!blocks_.IsInRange(search.voxel)) return search.found;
  SearchAround(search, 1);
  const int radius_voxels = std::min(static_cast<int>(std::ceil(blocks_.Scaled(radius_m))),
                                     PointMapParameters::kMaxSearch_voxels);
  if (search.found.count < search.wanted && radius_voxels > 1) SearchAround(search, radius_voxels);
  return search.found;
}

PointMap::Content PointMap::ContentAt(const Vector3& point_map) const {
  const VoxelCell voxel = blocks_.VoxelAt(point_map);
  Content content;
  if (!blocks_.IsInRange(voxel)) return content;
  const std::int32_t number = blocks_.Find(voxel);
  if (number == Blocks::kNone) return content;
  const Blocks::Block& block = blocks_.block(number);
  const auto i = ToIndex(Blocks::InBlock(voxel));
  if (!(block.occupied >> i & 1)) return content;
  content.num_points = static_cast<int>(block.voxels[i].w());
  content.is_frozen = content.num_points >= options_.max_voxel_points;
  return content;
}

void PointMap::AddPoint(const Vector3& point_map) {
  const VoxelCell voxel = blocks_.VoxelAt(point_map);
  if (!blocks_.IsInRange(voxel)) return;
  const VoxelIndex::Added added = blocks_.FindOrAdd(voxel);
  if (!added.is_new) blocks_.Touch(added.voxel);
  Blocks::Block& block = blocks_.block(added.voxel);
  const auto i = ToIndex(Blocks::InBlock(voxel));
  Mean& mean = block.voxels[i];
  if (!(block.occupied >> i & 1)) {
    block.occupied |= std::uint64_t{1} << i;
    mean.setZero();
    ++num_voxels_;
  }
  if (mean.w() >= static_cast<float>(options_.max_voxel_points)) return;
  const Eigen::Vector3f local = (point_map - blocks_.CornerOf(block)).cast<float>();
  mean.w() += 1.f;
  mean.head<3>() += (local - mean.head<3>()) / mean.w();
}

void PointMap::Remove(std::int32_t block) {
  num_voxels_ -= static_cast<std::size_t>(std::popcount(blocks_.block(block).occupied));
  blocks_.Remove(block);
}

void PointMap::Insert(std::span<const Vector3> points_map, const Vector3& centre_map) {
  for (const Vector3& point : points_map) AddPoint(point);
  const double limit_sq = options_.max_distance_m * options_.max_distance_m;
  const Vector3 to_centre = Vector3::Constant(0.5 * kBlockEdge * options_.voxel_m);
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(blocks_.capacity()); ++i) {
    if (!blocks_.IsUsed(i)) continue;
    const Vector3 centre = blocks_.CornerOf(blocks_.block(i)) + to_centre;
    if ((centre - centre_map).squaredNorm() > limit_sq) Remove(i);
  }
  while (num_voxels_ > static_cast<std::size_t>(options_.max_voxels)) Remove(blocks_.oldest());
}

}  // namespace lio
