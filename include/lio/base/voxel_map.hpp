// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// This is the one hashed container of voxels and what they hold. The contents are its user's
// policy: Gaussian cells, blocks of means or of points of keyframes, moments, chains of points.
// Each type of content has an array of its own beside VoxelIndex, so that a search that reads one
// does not fetch the others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>

#include "lio/base/chunked_array.hpp"
#include "lio/base/voxel_index.hpp"

namespace lio {

template <class... Contents>
class VoxelMap : private VoxelIndex {
 public:
  using VoxelIndex::Added;
  using VoxelIndex::capacity;
  using VoxelIndex::Clear;  // keeps the memory of the contents
  using VoxelIndex::Find;
  using VoxelIndex::IsUsed;
  using VoxelIndex::key;
  using VoxelIndex::kNone;
  using VoxelIndex::oldest;
  using VoxelIndex::Prefetch;
  using VoxelIndex::Remove;
  using VoxelIndex::size;
  using VoxelIndex::Touch;

  // Works as VoxelIndex::FindOrAdd; a new voxel holds Content{} of each type. References to
  // contents stay valid.
  Added FindOrAdd(VoxelKey key) {
    const Added added = VoxelIndex::FindOrAdd(key);
    if (added.is_new) (Renew(ArrayOf<Contents>(), static_cast<std::size_t>(added.voxel)), ...);
    return added;
  }
  // Returns the content of a number below capacity(); that of a removed voxel is what was left
  // there.
  template <class Content>
  [[nodiscard]] Content& Of(std::int32_t voxel) {
    return ArrayOf<Content>()[static_cast<std::size_t>(voxel)];
  }
  template <class Content>
  [[nodiscard]] const Content& Of(std::int32_t voxel) const {
    return std::get<ChunkedArray<Content>>(contents_)[static_cast<std::size_t>(voxel)];
  }
  [[nodiscard]] std::size_t memory_bytes() const {
    return VoxelIndex::memory_bytes() +
           (... + std::get<ChunkedArray<Contents>>(contents_).memory_bytes());
  }

 private:
  template <class Content>
  ChunkedArray<Content>& ArrayOf() {
    return std::get<ChunkedArray<Content>>(contents_);
  }
  // Numbers are given one after the other, or anew.
  template <class Content>
  static void Renew(ChunkedArray<Content>& contents, std::size_t at) {
    contents.MakeRoomAt(at);
    contents[at] = Content{};
  }

  std::tuple<ChunkedArray<Contents>...> contents_;  // by number
};

}  // namespace lio
