// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/voxel_index.hpp"

namespace lio {

VoxelIndex::Added VoxelIndex::FindOrAdd(VoxelKey key) {
  const std::size_t at = SlotOf(key);
  if (slots_[at].voxel != kNone) return {slots_[at].voxel, false};
  std::int32_t voxel;
  if (free_.empty()) {
    voxel = static_cast<std::int32_t>(nodes_.size());
    nodes_.emplace_back();
  } else {
    voxel = free_.back();
    free_.pop_back();
  }
  node(voxel) = {key, kNone, kNone, true};
  slots_[at] = {key, voxel};
  LinkNewest(voxel);
  if (++num_voxels_ * 2 > slots_.size()) Grow();
  return {voxel, true};
}

void VoxelIndex::Grow() {
  std::vector<Slot> old(slots_.size() * 2);
  old.swap(slots_);
  for (const Slot& slot : old) {
    if (slot.voxel != kNone) slots_[SlotOf(slot.key)] = slot;
  }
}

void VoxelIndex::LinkNewest(std::int32_t voxel) {
  node(voxel).older = newest_;
  node(voxel).newer = kNone;
  if (newest_ != kNone) node(newest_).newer = voxel;
  newest_ = voxel;
  if (oldest_ == kNone) oldest_ = voxel;
}

void VoxelIndex::Unlink(std::int32_t voxel) {
  const Node& n = node(voxel);
  (n.newer == kNone ? newest_ : node(n.newer).older) = n.older;
  (n.older == kNone ? oldest_ : node(n.older).newer) = n.newer;
}

void VoxelIndex::Touch(std::int32_t voxel) {
  if (newest_ == voxel) return;
  Unlink(voxel);
  LinkNewest(voxel);
}

// Removal from a table with linear probing: later entries of the run move up into the hole.
void VoxelIndex::EraseSlot(std::size_t at) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t hole = at;
  for (std::size_t next = (hole + 1) & mask; slots_[next].voxel != kNone;
       next = (next + 1) & mask) {
    const std::size_t home = HashVoxel(slots_[next].key) & mask;
    const bool stays = ((next - home) & mask) < ((next - hole) & mask);
    if (stays) continue;
    slots_[hole] = slots_[next];
    hole = next;
  }
  slots_[hole] = {};
}

void VoxelIndex::Remove(std::int32_t voxel) {
  EraseSlot(SlotOf(node(voxel).key));
  Unlink(voxel);
  node(voxel).is_used = false;
  free_.push_back(voxel);
  --num_voxels_;
}

}  // namespace lio
