// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A bounded map of points for nearest-neighbour search: voxels, each the running mean of the points
// that fell into it, in blocks of 4 x 4 x 4. Positions are kept relative to their block, so that
// precision does not depend on the distance from the origin. Not safe for concurrent use while
// inserting.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lio/base/rotation.hpp"
#include "lio/base/voxel_index.hpp"

namespace lio {

struct PointMapOptions {
  double voxel_m = 0.4;
  int max_voxel_points = 20;  // a voxel with as many is frozen
  int max_voxels = 100000;    // beyond it the blocks that were not added to for longest go
  double max_distance_m = 200.0;
};

class PointMap {
 public:
  static constexpr int kMaxNeighbours = 8;

  // Throws std::invalid_argument when an option is out of its range.
  explicit PointMap(const PointMapOptions& options);

  struct Neighbour {
    Eigen::Vector3f from_query = Eigen::Vector3f::Zero();  // map axes
    float distance_sq = 0.f;
    float num_points = 0.f;  // that the voxel is the mean of
    std::int32_t block = VoxelIndex::kNone;
  };
  struct Neighbours {
    std::array<Neighbour, kMaxNeighbours> list;  // nearest first
    int count = 0;
  };

  // The `wanted` nearest points among the 27 voxels around the query, or, where these hold fewer,
  // among all within `radius_m`; none beyond that radius.
  Neighbours FindNearest(const Vector3& query_map, int wanted, double radius_m) const;

  // What the voxel around a point holds, for the share of new content.
  struct Content {
    VoxelKey key = 0;  // an integer name of the voxel
    int num_points = 0;
    bool is_frozen = false;
  };
  Content ContentAt(const Vector3& point_map) const;

  // Adds a scan; then drops the blocks whose centre is farther than max_distance_m from
  // `centre_map`, and as many old blocks as the bound on voxels asks for.
  void Insert(std::span<const Vector3> points_map, const Vector3& centre_map);

  std::size_t num_voxels() const { return num_voxels_; }
  // Upper bound of block indices, for scratch arrays beside the map.
  std::size_t block_capacity() const { return blocks_.size(); }
  std::size_t memory_bytes() const;

 private:
  static constexpr int kVoxels = kBlockEdge * kBlockEdge * kBlockEdge;

  struct Block {
    std::uint64_t occupied = 0;                 // a bit a voxel: x + 4 y + 16 z
    VoxelCell at{};                             // in blocks
    std::array<Eigen::Vector4f, kVoxels> mean;  // from the block's corner [m]; their number
  };
  struct Search;

  static std::size_t ToIndex(std::int32_t i) { return static_cast<std::size_t>(i); }
  static bool IsInRange(const VoxelCell& voxel);
  Vector3 CornerOf(const Block& block) const;
  void SearchAround(Search& search, int reach_voxels) const;
  void AddPoint(const Vector3& point_map);
  void Remove(std::int32_t block);

  PointMapOptions options_;
  double inverse_voxel_;
  VoxelIndex index_;  // of blocks
  std::vector<Block> blocks_;
  std::size_t num_voxels_ = 0;
};

}  // namespace lio
