// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A set of voxels that is emptied in no time, for thinning. No allocation once warm.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "lio/base/voxel_key.hpp"

namespace lio {

class VoxelSet {
 public:
  void Clear() {
    num_keys_ = 0;
    if (++epoch_ != 0) return;
    slots_.assign(slots_.size(), Slot{});  // wrapped
    epoch_ = 1;
  }

  // False when the key was in it already.
  bool Insert(VoxelKey key) {
    Slot& slot = Find(key);
    if (slot.epoch == epoch_) return false;
    slot = {key, epoch_};
    if (++num_keys_ * 2 > slots_.size()) Grow();
    return true;
  }

  std::size_t size() const { return num_keys_; }

 private:
  struct Slot {
    VoxelKey key = 0;
    std::uint32_t epoch = 0;
  };

  Slot& Find(VoxelKey key) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = HashVoxel(key) & mask;
    while (slots_[at].epoch == epoch_ && slots_[at].key != key) at = (at + 1) & mask;
    return slots_[at];
  }
  void Grow() {
    std::vector<Slot> old(slots_.size() * 4);
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.epoch == epoch_) Find(slot.key) = slot;
    }
  }

  std::vector<Slot> slots_ = std::vector<Slot>(1u << 10);  // open addressing, a power of two
  std::uint32_t epoch_ = 1;                                // slots of older epochs are free
  std::size_t num_keys_ = 0;
};

}  // namespace lio
