// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/parallel.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <stdexcept>

namespace lio {
namespace {

Block BlockAt(std::size_t number, std::size_t count) {
  const std::size_t begin = number * Workers::kBlockSize;
  return {number, begin, std::min(begin + Workers::kBlockSize, count)};
}

// No more than the program allows: TBB prints a warning when an arena asks for more.
int Allowed(int num_threads) {
  const std::size_t limit =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return static_cast<int>(std::min(static_cast<std::size_t>(num_threads), limit));
}

}  // namespace

struct Workers::Arena {
  explicit Arena(int num_threads) : arena(Allowed(num_threads)) {}

  tbb::task_arena arena;
};

Workers::Workers(int num_threads) {
  if (num_threads < 1) throw std::invalid_argument("Workers: needs at least one thread");
  if (num_threads > 1) arena_ = std::make_unique<Arena>(num_threads);
}

Workers::~Workers() = default;

void Workers::ForEachBlock(std::size_t count, const std::function<void(const Block&)>& work) const {
  const std::size_t num_blocks = (count + kBlockSize - 1) / kBlockSize;
  if (!arena_) {
    for (std::size_t i = 0; i < num_blocks; ++i) work(BlockAt(i, count));
    return;
  }
  arena_->arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, num_blocks, [&](std::size_t i) { work(BlockAt(i, count)); });
  });
}

}  // namespace lio
