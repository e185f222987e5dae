// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds an array that grows without moving what it holds: a vector would copy all of it now and
// then, in the midst of a scan, and keep up to twice the memory.
#pragma once

#include <bit>
#include <cstddef>
#include <memory>
#include <vector>

namespace lio {

template <class Content>
class ChunkedArray {
 public:
  [[nodiscard]] Content& operator[](std::size_t at) { return chunks_[at >> kBits][at & kMask]; }
  [[nodiscard]] const Content& operator[](std::size_t at) const {
    return chunks_[at >> kBits][at & kMask];
  }
  // Makes room for one at `at`, which is at most the number of those that have room. Its content is
  // what was left there.
  void MakeRoomAt(std::size_t at) {
    if (at >> kBits == chunks_.size()) chunks_.push_back(std::make_unique<Content[]>(kSize));
  }
  [[nodiscard]] std::size_t memory_bytes() const {
    return chunks_.size() * kSize * sizeof(Content) +
           chunks_.capacity() * sizeof(std::unique_ptr<Content[]>);
  }

 private:
  // Chosen: half of the size from which glibc asks the kernel for each block.
  static constexpr std::size_t kMaxChunkBytes = 65536;
  static_assert(sizeof(Content) <= kMaxChunkBytes);
  static constexpr int kBits = std::bit_width(kMaxChunkBytes / sizeof(Content)) - 1;
  static constexpr std::size_t kSize = std::size_t{1} << kBits;
  static constexpr std::size_t kMask = kSize - 1;

  std::vector<std::unique_ptr<Content[]>> chunks_;
};

}  // namespace lio
