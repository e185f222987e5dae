// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Loops on several threads that give the same bits on any number of them: work is cut into blocks
// of a fixed size, and sums over blocks are added in the blocks' order, whichever thread made them.
// The threads are TBB's, in an arena of their own: the program around the estimator keeps its own
// parallelism, and a limit that it sets on TBB's threads holds here, too.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace lio {

struct Block {
  std::size_t number = 0;
  std::size_t begin = 0;  // indices of the loop
  std::size_t end = 0;
};

class Workers {
 public:
  // A block has so many indices of the loop. Chosen: the 2500 points of a match are 20 blocks,
  // enough for threads to share; smaller ones cost more to hand out. Sums depend on it in their
  // last bits.
  static constexpr std::size_t kBlockSize = 128;

  // At most `num_threads` run at once, the caller's among them, and never more than TBB has (one a
  // core). One starts none. Throws std::invalid_argument below one.
  explicit Workers(int num_threads);
  ~Workers();

  // Calls work(block) for all blocks of 0 .. count - 1, in any order and at the same time; with one
  // thread in order. An exception that it throws comes out here.
  void ForEachBlock(std::size_t count, const std::function<void(const Block&)>& work) const;

  // Returns the sum of block_sum(block) over the blocks, in their order.
  template <class Sum, class BlockSum>
  [[nodiscard]] Sum SumOverBlocks(std::size_t count, const BlockSum& block_sum) const {
    std::vector<Sum> sums((count + kBlockSize - 1) / kBlockSize);
    ForEachBlock(count, [&](const Block& block) { sums[block.number] = block_sum(block); });
    Sum total{};
    for (const Sum& sum : sums) total += sum;
    return total;
  }

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;  // none with one thread
};

}  // namespace lio
