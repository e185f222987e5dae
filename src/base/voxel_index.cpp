// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/voxel_index.hpp"

namespace lio {

VoxelIndex::Added VoxelIndex::FindOrAdd(VoxelKey key) {
  const auto [number, is_new] = numbers_.FindOrAdd(key);
  if (!is_new) return {number.voxel, false};
  if (free_.empty()) {
    number.voxel = static_cast<std::int32_t>(nodes_.size());
    nodes_.emplace_back();
  } else {
    number.voxel = free_.back();
    free_.pop_back();
  }
  node(number.voxel) = {key, kNone, kNone, true};
  LinkNewest(number.voxel);
  return {number.voxel, true};
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

void VoxelIndex::Remove(std::int32_t voxel) {
  numbers_.Erase(node(voxel).key);
  Unlink(voxel);
  node(voxel).is_used = false;
  free_.push_back(voxel);
}

}  // namespace lio
