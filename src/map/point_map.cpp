// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/point_map.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

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

constexpr int kMaxReach = 12;  // voxels: a search never goes farther

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
    : options_(options), inverse_voxel_(1.0 / options.voxel_m) {
  if (!(options.voxel_m > 0) || options.max_voxel_points < 1 || options.max_voxels < 1 ||
      !(options.max_distance_m > 0)) {
    throw std::invalid_argument("PointMap: an option is out of range");
  }
}

bool PointMap::IsInRange(const VoxelCell& voxel) {
  return std::all_of(voxel.begin(), voxel.end(), [](std::int32_t v) {
    return std::abs(v) < kVoxelCoordinateLimit - 2 * kMaxReach;
  });
}

Vector3 PointMap::CornerOf(const Block& block) const {
  return kBlockEdge * options_.voxel_m * Vector3(block.at[0], block.at[1], block.at[2]);
}

// All voxels within so many voxels of the query's own, block by block.
void PointMap::SearchAround(Search& search, int reach_voxels) const {
  search.found.count = 0;
  VoxelCell low, high;
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = search.voxel[i] - reach_voxels;
    high[i] = search.voxel[i] + reach_voxels;
  }
  const auto mask_along = [&](std::size_t axis, std::int32_t block) {
    const std::int32_t corner = block * kBlockEdge;
    return kAxisMasks.of[axis][ToIndex(std::max(low[axis] - corner, 0))]
                        [ToIndex(std::min(high[axis] - corner, kBlockEdge - 1))];
  };
  const auto search_block = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    const std::int32_t number = index_.Find(PackVoxel(x, y, z));
    if (number == VoxelIndex::kNone) return;
    const Block& block = blocks_[ToIndex(number)];
    const Eigen::Vector3f query = (search.query - CornerOf(block)).cast<float>();
    const std::uint64_t mask = mask_along(0, x) & mask_along(1, y) & mask_along(2, z);
    for (std::uint64_t bits = block.occupied & mask; bits != 0; bits &= bits - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(bits));
      const Eigen::Vector3f from_query = block.mean[i].head<3>() - query;
      search.Offer({from_query, from_query.squaredNorm(), block.mean[i].w(), number});
    }
  };
  ForEachVoxel(BlockOf(low), BlockOf(high), search_block);
}

PointMap::Neighbours PointMap::FindNearest(const Vector3& query_map, int wanted,
                                           double radius_m) const {
  Search search{query_map,
                VoxelOf(inverse_voxel_ * query_map),
                std::min(wanted, kMaxNeighbours),
                static_cast<float>(radius_m * radius_m),
                {}};
  if (!IsInRange(search.voxel)) return search.found;
  SearchAround(search, 1);
  const int reach = std::min(static_cast<int>(std::ceil(radius_m * inverse_voxel_)), kMaxReach);
  if (search.found.count < search.wanted && reach > 1) SearchAround(search, reach);
  return search.found;
}

PointMap::Content PointMap::ContentAt(const Vector3& point_map) const {
  const VoxelCell voxel = VoxelOf(inverse_voxel_ * point_map);
  Content content;
  if (!IsInRange(voxel)) return content;
  content.key = PackVoxel(voxel[0], voxel[1], voxel[2]);
  const std::int32_t number = index_.Find(PackVoxel(voxel[0] >> 2, voxel[1] >> 2, voxel[2] >> 2));
  if (number == VoxelIndex::kNone) return content;
  const Block& block = blocks_[ToIndex(number)];
  const auto i = ToIndex((voxel[0] & 3) + 4 * (voxel[1] & 3) + 16 * (voxel[2] & 3));
  if (!(block.occupied >> i & 1)) return content;
  content.num_points = static_cast<int>(block.mean[i].w());
  content.is_frozen = content.num_points >= options_.max_voxel_points;
  return content;
}

void PointMap::AddPoint(const Vector3& point_map) {
  const VoxelCell voxel = VoxelOf(inverse_voxel_ * point_map);
  if (!IsInRange(voxel)) return;
  const VoxelCell at = BlockOf(voxel);
  const VoxelIndex::Added added = index_.FindOrAdd(PackVoxel(at[0], at[1], at[2]));
  if (blocks_.size() < index_.capacity()) blocks_.resize(index_.capacity());
  Block& block = blocks_[ToIndex(added.voxel)];
  if (added.is_new) {
    block.occupied = 0;
    block.at = at;
  } else {
    index_.Touch(added.voxel);
  }
  const auto i = ToIndex((voxel[0] & 3) + 4 * (voxel[1] & 3) + 16 * (voxel[2] & 3));
  Eigen::Vector4f& mean = block.mean[i];
  if (!(block.occupied >> i & 1)) {
    block.occupied |= std::uint64_t{1} << i;
    mean.setZero();
    ++num_voxels_;
  }
  if (mean.w() >= static_cast<float>(options_.max_voxel_points)) return;
  const Eigen::Vector3f local = (point_map - CornerOf(block)).cast<float>();
  mean.w() += 1.f;
  mean.head<3>() += (local - mean.head<3>()) / mean.w();
}

void PointMap::Remove(std::int32_t block) {
  num_voxels_ -= static_cast<std::size_t>(std::popcount(blocks_[ToIndex(block)].occupied));
  blocks_[ToIndex(block)].occupied = 0;
  index_.Remove(block);
}

void PointMap::Insert(std::span<const Vector3> points_map, const Vector3& centre_map) {
  for (const Vector3& point : points_map) AddPoint(point);
  const double limit_sq = options_.max_distance_m * options_.max_distance_m;
  const Vector3 to_centre = Vector3::Constant(0.5 * kBlockEdge * options_.voxel_m);
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(blocks_.size()); ++i) {
    if (!index_.IsUsed(i)) continue;
    if ((CornerOf(blocks_[ToIndex(i)]) + to_centre - centre_map).squaredNorm() > limit_sq) {
      Remove(i);
    }
  }
  while (num_voxels_ > static_cast<std::size_t>(options_.max_voxels)) Remove(index_.oldest());
}

std::size_t PointMap::memory_bytes() const {
  return blocks_.capacity() * sizeof(Block) + index_.memory_bytes();
}

}  // namespace lio
