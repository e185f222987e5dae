// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds the hashed voxel map whose voxels lie in blocks of 4 x 4 x 4, so that a search passes over
// empty space 64 voxels at a time. A voxel's content is the map's policy: a mean in PointMap, a
// chain of points in KeyframeMap. Positions are kept relative to their block's corner, so that
// precision does not depend on the distance from the origin.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

#include "lio/base/rotation.hpp"
#include "lio/base/voxel_map.hpp"

namespace lio {

template <class PerVoxel>
class VoxelBlocks {
 public:
  static constexpr std::int32_t kNone = VoxelIndex::kNone;
  static constexpr std::size_t kVoxels = std::size_t{kBlockEdge} * kBlockEdge * kBlockEdge;

  struct Block {
    std::uint64_t occupied = 0;            // a bit a voxel: x + 4 y + 16 z
    VoxelCell at{};                        // in blocks
    std::array<PerVoxel, kVoxels> voxels;  // valid where occupied
  };

  // `voxel_m` is the edge; `margin_voxels` tells how far a search goes beyond a voxel.
  VoxelBlocks(double voxel_m, int margin_voxels)
      : voxel_m_(voxel_m), inverse_voxel_(1.0 / voxel_m), margin_(margin_voxels) {}

  // Returns coordinates in voxels.
  [[nodiscard]] Vector3 Scaled(const Vector3& point_map) const {
    return inverse_voxel_ * point_map;
  }
  [[nodiscard]] double Scaled(double length_m) const { return inverse_voxel_ * length_m; }
  [[nodiscard]] VoxelCell VoxelAt(const Vector3& point_map) const {
    return VoxelOf(Scaled(point_map));
  }
  // Can a search around the voxel be expressed?
  [[nodiscard]] bool IsInRange(const VoxelCell& voxel) const {
    return std::all_of(voxel.begin(), voxel.end(), [&](std::int32_t v) {
      return std::abs(v) < kVoxelCoordinateLimit - 2 * margin_;
    });
  }
  // Returns the voxel's bit and place in its block.
  [[nodiscard]] static std::int32_t InBlock(const VoxelCell& voxel) {
    return (voxel[0] & 3) + 4 * (voxel[1] & 3) + 16 * (voxel[2] & 3);
  }

  // Returns the number of the block around a voxel, kNone where there is none.
  [[nodiscard]] std::int32_t Find(const VoxelCell& voxel) const {
    const VoxelCell at = BlockOf(voxel);
    return blocks_.Find(PackVoxel(at[0], at[1], at[2]));
  }
  // A new block is empty, and the last touched.
  VoxelIndex::Added FindOrAdd(const VoxelCell& voxel) {
    const VoxelCell at = BlockOf(voxel);
    const VoxelIndex::Added added = blocks_.FindOrAdd(PackVoxel(at[0], at[1], at[2]));
    if (added.is_new) block(added.voxel).at = at;
    return added;
  }
  void Touch(std::int32_t number) { blocks_.Touch(number); }
  void Remove(std::int32_t number) {
    block(number).occupied = 0;
    blocks_.Remove(number);
  }

  [[nodiscard]] Block& block(std::int32_t number) { return blocks_.template Of<Block>(number); }
  [[nodiscard]] const Block& block(std::int32_t number) const {
    return blocks_.template Of<Block>(number);
  }
  [[nodiscard]] Vector3 CornerOf(const Block& block) const {
    return kBlockEdge * voxel_m_ * Vector3(block.at[0], block.at[1], block.at[2]);
  }
  // Calls visit(number, block) for all blocks that hold voxels from `low` to `high`, both included,
  // by place, x fastest.
  template <class Visit>
  void ForEachBlock(const VoxelCell& low, const VoxelCell& high, const Visit& visit) const {
    ForEachVoxel(BlockOf(low), BlockOf(high), [&](std::int32_t x, std::int32_t y, std::int32_t z) {
      const std::int32_t number = blocks_.Find(PackVoxel(x, y, z));
      if (number != kNone) visit(number, block(number));
    });
  }

  [[nodiscard]] bool IsUsed(std::int32_t number) const { return blocks_.IsUsed(number); }
  // Returns the block that was touched longest ago, kNone when there is none.
  [[nodiscard]] std::int32_t oldest() const { return blocks_.oldest(); }
  // Returns an upper bound of the numbers.
  [[nodiscard]] std::size_t capacity() const { return blocks_.capacity(); }
  [[nodiscard]] std::size_t memory_bytes() const { return blocks_.memory_bytes(); }

 private:
  double voxel_m_;
  double inverse_voxel_;
  int margin_;
  VoxelMap<Block> blocks_;
};

}  // namespace lio
