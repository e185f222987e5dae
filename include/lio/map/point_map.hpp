// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds a bounded map of points for nearest-neighbour search: voxels, each the running mean of the
// points that fell into it. Not safe for concurrent use while inserting.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lio/base/rotation.hpp"
#include "lio/map/voxel_blocks.hpp"

namespace lio {

struct PointMapOptions {
  double voxel_m = 0.4;       // edge; as LoamOptions::surface_leaf_m
  int max_voxel_points = 20;  // a voxel with as many is frozen; as LoamOptions::max_leaf_points
  // This bounds the memory; blocks without new points for longest go first. Chosen: half of
  // LoamOptions::max_leaves, which LOAM sets instead.
  int max_voxels = 100000;
  double max_distance_m = 200.0;  // blocks farther away are dropped; as NdtOptions::max_distance_m
};

class PointMap {
 public:
  // Holds the mean of a voxel's points, from the block's corner [m], and their number.
  using Mean = Eigen::Vector4f;
  static constexpr int kMaxNeighbours = 8;  // room in Neighbours; as the range of num_neighbours

  // Throws std::invalid_argument when an option is out of its range.
  explicit PointMap(const PointMapOptions& options);

  struct Neighbour {
    Eigen::Vector3f from_query = Eigen::Vector3f::Zero();  // map axes
    float distance_sq = 0.f;
    float num_points = 0.f;  // the mean is over so many
    std::int32_t block = VoxelBlocks<Mean>::kNone;
  };
  struct Neighbours {
    std::array<Neighbour, kMaxNeighbours> list;  // nearest first
    int count = 0;
  };

  // Returns the `wanted` nearest points among the 27 voxels around the query, or, where these hold
  // fewer, among all within `radius_m`; none beyond that radius.
  [[nodiscard]] Neighbours FindNearest(const Vector3& query_map, int wanted, double radius_m) const;

  // Holds the voxel around a point, for the share of new content.
  struct Content {
    int num_points = 0;
    bool is_frozen = false;
  };
  [[nodiscard]] Content ContentAt(const Vector3& point_map) const;

  // Adds a scan; then drops the blocks whose centre is farther than max_distance_m from
  // `centre_map`, and as many old blocks as the bound on voxels asks for.
  void Insert(std::span<const Vector3> points_map, const Vector3& centre_map);

  [[nodiscard]] std::size_t num_voxels() const { return num_voxels_; }
  // Returns an upper bound of block indices, for scratch arrays beside the map.
  [[nodiscard]] std::size_t block_capacity() const { return blocks_.capacity(); }
  [[nodiscard]] std::size_t memory_bytes() const { return blocks_.memory_bytes(); }

 private:
  using Blocks = VoxelBlocks<Mean>;
  struct Search;

  static std::size_t ToIndex(std::int32_t i) { return static_cast<std::size_t>(i); }
  void SearchAround(Search& search, int radius_voxels) const;
  void AddPoint(const Vector3& point_map);
  void Remove(std::int32_t block);

  PointMapOptions options_;
  Blocks blocks_;
  std::size_t num_voxels_ = 0;
};

}  // namespace lio
