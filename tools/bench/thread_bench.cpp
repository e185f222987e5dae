// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Measures how much faster NDT matches a large scan on several threads. A match on one thread and
// one on several alternate, so that other load on the machine affects both alike; `ratio` is that
// of the medians.
//   build/bin/lio-bench-match --benchmark_filter=BM_NdtThreads
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>

#include "support/method_bench.hpp"

namespace lio {
namespace {

// Nearly all of the 32 000 points are matched.
Options LargeScans(int num_threads) {
  Options options = test::MethodOptions(MatchMethod::kNdt);
  options.reduce.target_points = 40'000;
  options.reduce.match_points = 40'000;
  options.reduce.voxel_m = options.reduce.min_voxel_m = 0.02;
  options.pipeline.num_threads = num_threads;
  return options;
}

double Median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void BM_NdtThreads(benchmark::State& state) {
  const auto num_threads = static_cast<int>(state.range(0));
  const test::RayScene scene = test::StreetScene();
  test::SpinningLidar lidar = test::SpinningLidar::Hdl32e();
  lidar.num_columns = 1960;
  lidar.range_std_m = 0.02;
  const Pose truth = test::SensorAt(0.73, 0.21, 0.05, 0.013, -0.007);
  test::MethodBench alone(LargeScans(1));
  test::MethodBench together(LargeScans(num_threads));
  for (int i = 0; i < 10; ++i) {
    const Pose pose = test::SensorAt(-2.0 + 0.4 * i, 0.3 * std::sin(i), 0.02 * std::sin(2.0 * i));
    const auto seed = static_cast<std::uint32_t>(i + 2);
    const test::MethodScan scan = alone.Reduce(CastTurn(scene, lidar, pose, seed).sweep);
    alone.Insert(scan, pose);
    together.Insert(scan, pose);
  }
  const test::MethodScan scan = alone.Reduce(CastTurn(scene, lidar, truth, 1).sweep);
  Vector6 offset;  // one sigma of a guess that an IMU carried over one sweep
  offset << 0.01, -0.01, 0.01, 0.001, 0.001, -0.001;
  MatchResult result;
  const auto seconds_of = [&](test::MethodBench& bench) {
    const auto begin = std::chrono::steady_clock::now();
    result = bench.Match(scan, truth * ExpSe3(offset), test::GuessCov(0.01, 0.001));
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  std::vector<double> alone_s;
  std::vector<double> together_s;
  for (auto _ : state) {
    alone_s.push_back(seconds_of(alone));
    together_s.push_back(seconds_of(together));
    state.SetIterationTime(together_s.back());
  }
  state.counters["matched"] = result.num_matched;
  state.counters["alone_ms"] = 1e3 * Median(alone_s);
  state.counters["together_ms"] = 1e3 * Median(together_s);
  state.counters["ratio"] = Median(alone_s) / Median(together_s);
}

BENCHMARK(BM_NdtThreads)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lio
