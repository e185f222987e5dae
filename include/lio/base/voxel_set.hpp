// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds a set of voxels, for thinning. It allocates nothing once warm.
#pragma once

#include "lio/base/voxel_table.hpp"

namespace lio {

class VoxelSet {
 public:
  void Clear() { table_.Clear(); }
  // Returns false when the key was in it already.
  bool Insert(VoxelKey key) { return table_.FindOrAdd(key).is_new; }
  [[nodiscard]] std::size_t size() const { return table_.size(); }

 private:
  struct Nothing {};

  VoxelTable<Nothing> table_;
};

}  // namespace lio
