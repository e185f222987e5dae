// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives each voxel that is in use a small integer, for arrays beside it, and knows which of them
// was touched longest ago. Numbers of removed voxels are given again. The numbers depend on the
// history of calls alone, not on addresses.
#pragma once

#include <cstdint>
#include <vector>

#include "lio/base/voxel_table.hpp"

namespace lio {

class VoxelIndex {
 public:
  static constexpr std::int32_t kNone = -1;

  // Returns the voxel's number; kNone where it is not in use.
  [[nodiscard]] std::int32_t Find(VoxelKey key) const { return numbers_.Find(key).voxel; }
  // Fetches what Find() and FindOrAdd() will look at.
  void Prefetch(VoxelKey key) const { numbers_.Prefetch(key); }
  // The voxel's number and whether it is new; a new one is the last touched.
  struct Added {
    std::int32_t voxel;
    bool is_new;
  };
  Added FindOrAdd(VoxelKey key);
  void Touch(std::int32_t voxel);
  void Remove(std::int32_t voxel);
  void Clear() { *this = {}; }

  [[nodiscard]] std::size_t size() const { return numbers_.size(); }
  // Returns an upper bound of the numbers given so far.
  [[nodiscard]] std::size_t capacity() const { return nodes_.size(); }
  [[nodiscard]] bool IsUsed(std::int32_t voxel) const { return node(voxel).is_used; }
  [[nodiscard]] VoxelKey key(std::int32_t voxel) const { return node(voxel).key; }
  [[nodiscard]] std::int32_t oldest() const { return oldest_; }  // kNone when empty
  [[nodiscard]] std::size_t memory_bytes() const {
    return numbers_.memory_bytes() + nodes_.capacity() * sizeof(Node);
  }

 private:
  struct Number {
    std::int32_t voxel = kNone;
  };
  struct Node {
    VoxelKey key = 0;
    std::int32_t newer = kNone;
    std::int32_t older = kNone;
    bool is_used = false;
  };

  Node& node(std::int32_t voxel) { return nodes_[static_cast<std::size_t>(voxel)]; }
  const Node& node(std::int32_t voxel) const { return nodes_[static_cast<std::size_t>(voxel)]; }
  void Unlink(std::int32_t voxel);
  void LinkNewest(std::int32_t voxel);

  VoxelTable<Number> numbers_;
  std::vector<Node> nodes_;  // by number, linked by age
  std::vector<std::int32_t> free_;
  std::int32_t newest_ = kNone;
  std::int32_t oldest_ = kNone;
};

}  // namespace lio
