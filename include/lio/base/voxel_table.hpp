// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// This is the one hash table of voxels: a value for each key, by open addressing with linear
// probing, at most half full. Everything that looks voxels up uses it: VoxelMap (by VoxelIndex,
// numbers and ages), VoxelSet (thinning) and ScanReducer (the point kept for each voxel).
//
// It is our own because it is faster than tsl::robin_map with the same hash and load (medians of
// 401 interleaved runs): 1.2 to 1.5 times for 20 000 searches among 115 000 voxels, 3 times for
// sets of 300 points, as one scan ring has.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "lio/base/voxel_key.hpp"

namespace lio {

inline constexpr VoxelKey kNoVoxel = ~VoxelKey{0};  // names no voxel: keys leave the top bit free

template <class Value>
class VoxelTable {
 public:
  // The table begins with `num_slots`, a power of two.
  explicit VoxelTable(std::size_t num_slots = 1u << 10) : slots_(num_slots) {}

  // Returns the value of a key; Value{} for one that is not there, kNoVoxel included.
  [[nodiscard]] const Value& Find(VoxelKey key) const { return slots_[SlotOf(key)].value; }
  // Fetches what Find() and FindOrAdd() will look at.
  void Prefetch(VoxelKey key) const {
    __builtin_prefetch(&slots_[HashVoxel(key) & (slots_.size() - 1)]);
  }

  // The value of a key and whether it was added now, then as Value{}. The reference holds until the
  // next key is added or removed. Not for kNoVoxel.
  struct Added {
    Value& value;
    bool is_new;
  };
  Added FindOrAdd(VoxelKey key) {
    std::size_t at = SlotOf(key);
    if (slots_[at].key != kNoVoxel) return {slots_[at].value, false};
    if (++num_keys_ * 2 > slots_.size()) {
      Grow();
      at = SlotOf(key);
    }
    slots_[at].key = key;
    return {slots_[at].value, true};
  }

  // The key must be there. Later entries of its run move up into the hole.
  void Erase(VoxelKey key) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t hole = SlotOf(key);
    for (std::size_t next = (hole + 1) & mask; slots_[next].key != kNoVoxel;
         next = (next + 1) & mask) {
      const std::size_t home = HashVoxel(slots_[next].key) & mask;
      const bool stays = ((next - home) & mask) < ((next - hole) & mask);
      if (stays) continue;
      slots_[hole] = slots_[next];
      hole = next;
    }
    slots_[hole] = {};
    --num_keys_;
  }

  // Keeps the memory.
  void Clear() {
    slots_.assign(slots_.size(), Slot{});
    num_keys_ = 0;
  }

  // visit(value) for all keys, in an order that depends on the table's history: no result may
  // depend on it.
  template <class Visit>
  void ForEachInAnyOrder(const Visit& visit) const {
    for (const Slot& slot : slots_) {
      if (slot.key != kNoVoxel) visit(slot.value);
    }
  }

  [[nodiscard]] std::size_t size() const { return num_keys_; }
  [[nodiscard]] std::size_t memory_bytes() const { return slots_.capacity() * sizeof(Slot); }

 private:
  struct Slot {
    VoxelKey key = kNoVoxel;
    [[no_unique_address]] Value value{};
  };

  std::size_t SlotOf(VoxelKey key) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = HashVoxel(key) & mask;
    while (slots_[at].key != kNoVoxel && slots_[at].key != key) at = (at + 1) & mask;
    return at;
  }
  void Grow() {
    std::vector<Slot> old(slots_.size() * 2);
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.key != kNoVoxel) slots_[SlotOf(slot.key)] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::size_t num_keys_ = 0;
};

}  // namespace lio
