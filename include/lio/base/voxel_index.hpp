// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives each voxel that is in use a small integer, for arrays beside it, and knows which of them
// was touched longest ago. Numbers of removed voxels are given again. What it does depends on the
// history of calls alone, not on addresses.
#pragma once

#include <cstdint>
#include <vector>

#include "lio/base/voxel_key.hpp"

namespace lio {

class VoxelIndex {
 public:
  static constexpr std::int32_t kNone = -1;

  std::int32_t Find(VoxelKey key) const { return slots_[SlotOf(key)].voxel; }
  // Fetches what Find() and FindOrAdd() will look at.
  void Prefetch(VoxelKey key) const {
    __builtin_prefetch(&slots_[HashVoxel(key) & (slots_.size() - 1)]);
  }
  // The voxel's number and whether it is new; a new one is the last touched.
  struct Added {
    std::int32_t voxel;
    bool is_new;
  };
  Added FindOrAdd(VoxelKey key);
  void Touch(std::int32_t voxel);
  void Remove(std::int32_t voxel);
  void Clear() { *this = {}; }

  std::size_t size() const { return num_voxels_; }
  // Upper bound of the numbers given so far.
  std::size_t capacity() const { return nodes_.size(); }
  bool IsUsed(std::int32_t voxel) const { return node(voxel).is_used; }
  VoxelKey key(std::int32_t voxel) const { return node(voxel).key; }
  std::int32_t oldest() const { return oldest_; }  // kNone when empty
  std::size_t memory_bytes() const {
    return slots_.capacity() * sizeof(Slot) + nodes_.capacity() * sizeof(Node);
  }

 private:
  struct Slot {
    VoxelKey key = 0;
    std::int32_t voxel = kNone;
  };
  struct Node {
    VoxelKey key = 0;
    std::int32_t newer = kNone;
    std::int32_t older = kNone;
    bool is_used = false;
  };
  static constexpr std::size_t kInitialSlots = 1u << 10;

  Node& node(std::int32_t voxel) { return nodes_[static_cast<std::size_t>(voxel)]; }
  const Node& node(std::int32_t voxel) const { return nodes_[static_cast<std::size_t>(voxel)]; }
  std::size_t SlotOf(VoxelKey key) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = HashVoxel(key) & mask;
    while (slots_[at].voxel != kNone && slots_[at].key != key) at = (at + 1) & mask;
    return at;
  }
  void Grow();
  void EraseSlot(std::size_t at);
  void Unlink(std::int32_t voxel);
  void LinkNewest(std::int32_t voxel);

  std::vector<Slot> slots_ = std::vector<Slot>(kInitialSlots);  // linear probing, a power of two
  std::vector<Node> nodes_;
  std::vector<std::int32_t> free_;
  std::size_t num_voxels_ = 0;
  std::int32_t newest_ = kNone;
  std::int32_t oldest_ = kNone;
};

}  // namespace lio
