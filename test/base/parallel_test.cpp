// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/base/parallel.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cmath>
#include <stdexcept>
#include <thread>

namespace lio {
namespace {

TEST(Parallel, EveryIndexIsVisitedOnce) {
  for (const int num_threads : {1, 2, 3, 8}) {
    const Workers workers(num_threads);
    for (const std::size_t count : {0u, 1u, 127u, 128u, 129u, 10'000u}) {
      std::vector<std::atomic<int>> visits(count);
      workers.ForEachBlock(count, [&](const Block& block) {
        EXPECT_EQ(block.begin, block.number * Workers::kBlockSize);
        for (std::size_t i = block.begin; i < block.end; ++i) ++visits[i];
      });
      for (const std::atomic<int>& each : visits) ASSERT_EQ(each, 1);
    }
  }
}

TEST(Parallel, OneThreadGoesInOrder) {
  std::vector<std::size_t> numbers;
  Workers(1).ForEachBlock(1000, [&](const Block& block) { numbers.push_back(block.number); });
  EXPECT_EQ(numbers, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(Parallel, SumsAreTheSameToTheLastBitOnAnyNumberOfThreads) {
  const auto sum_of = [](const Block& block) {
    float sum = 0.f;  // sensitive to order
    for (std::size_t i = block.begin; i < block.end; ++i) {
      sum += 1.f / (1.f + static_cast<float>(i));
    }
    return sum;
  };
  constexpr std::size_t kCount = 30'001;
  const auto expected = Workers(1).SumOverBlocks<float>(kCount, sum_of);
  EXPECT_NEAR(expected, std::log(30'001.0) + 0.5772, 1e-3);
  for (const int num_threads : {2, 3, 8}) {
    const Workers workers(num_threads);
    for (int i = 0; i < 20; ++i) {
      ASSERT_EQ(workers.SumOverBlocks<float>(kCount, sum_of), expected) << num_threads;
    }
  }
}

TEST(Parallel, WhatTheWorkThrowsComesOut) {
  for (const int num_threads : {1, 3}) {
    const Workers workers(num_threads);
    EXPECT_THROW(workers.ForEachBlock(1000, [](const Block&) { throw std::runtime_error("no"); }),
                 std::runtime_error);
  }
}

TEST(Parallel, TheProgramAroundItKeepsItsOwnThreads) {
  constexpr auto kLimit = tbb::global_control::max_allowed_parallelism;
  const std::size_t before = tbb::global_control::active_value(kLimit);
  const int arena_before = tbb::this_task_arena::max_concurrency();
  for (const int num_threads : {1, 2, 64}) {
    const Workers workers(num_threads);
    std::atomic<std::size_t> sum = 0;
    workers.ForEachBlock(1000, [&](const Block& block) { sum += block.end - block.begin; });
    EXPECT_EQ(sum, 1000u);
    EXPECT_EQ(tbb::global_control::active_value(kLimit), before) << num_threads;
    EXPECT_EQ(tbb::this_task_arena::max_concurrency(), arena_before) << num_threads;
  }
}

TEST(Parallel, ALimitOfTheProgramAroundItHolds) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  const auto caller = std::this_thread::get_id();
  std::atomic<int> num_elsewhere = 0;
  Workers(8).ForEachBlock(10'000, [&](const Block&) {
    if (std::this_thread::get_id() != caller) ++num_elsewhere;
  });
  EXPECT_EQ(num_elsewhere, 0);
}

TEST(Parallel, NoThreadsAreRefused) {
  EXPECT_THROW(Workers(0), std::invalid_argument);
}

}  // namespace
}  // namespace lio
