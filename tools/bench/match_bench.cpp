// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Measures each method's parts on one HDL-32E sweep of about 60 000 returns: reduction, match from
// a guess such as an IMU gives, insertion. Run
//   build/bin/lio-bench-match --benchmark_repetitions=9 --benchmark_report_aggregates_only=true
// and read the medians.
#include <benchmark/benchmark.h>

#include "lio/scan/mixed_pixels.hpp"
#include "support/method_bench.hpp"

namespace lio {
namespace {

constexpr int kNumMapScans = 25;

// Holds one street, mapped along 10 m of a drive, and the sweep to match.
struct Street {
  std::vector<Sweep> drive;
  std::vector<Pose> poses;
  Sweep sweep;
  Pose truth = test::SensorAt(0.73, 0.21, 0.05, 0.013, -0.007);

  Street() {
    const test::RayScene scene = test::StreetScene();
    test::SpinningLidar lidar = test::SpinningLidar::Hdl32e();
    lidar.num_columns = 1960;  // 60 000 returns here
    lidar.range_std_m = 0.02;
    for (int i = 0; i < kNumMapScans; ++i) {
      poses.push_back(test::SensorAt(-7.0 + 0.4 * i, 0.3 * std::sin(i), 0.02 * std::sin(2.0 * i)));
      drive.push_back(
          CastTurn(scene, lidar, poses.back(), static_cast<std::uint32_t>(i + 2)).sweep);
    }
    sweep = CastTurn(scene, lidar, truth, 1).sweep;
  }
};

const Street& TheStreet() {
  static const Street kStreet;  // made once for all benchmarks
  return kStreet;
}

test::MethodBench MakeBench(MatchMethod method) {
  test::MethodBench bench(method);
  const Street& street = TheStreet();
  for (std::size_t i = 0; i < street.drive.size(); ++i) {
    bench.Insert(bench.Reduce(street.drive[i]), street.poses[i]);
  }
  return bench;
}

void BM_Reduce(benchmark::State& state) {
  Options options = test::MethodOptions(static_cast<MatchMethod>(state.range(0)));
  const auto reducer = MakeReducer(options, {});
  for (int i = 0; i < 10; ++i) reducer->Reduce(TheStreet().sweep);  // the thinning settles
  for (auto _ : state) benchmark::DoNotOptimize(reducer->Reduce(TheStreet().sweep));
  state.counters["returns"] = static_cast<double>(TheStreet().sweep.points.size());
}

// The search for mixed pixels as it is part of NDT's reduction: the whole sweep is looked at, and
// of the points that thinning leaves each is judged. It may take 0.15 ms.
void BM_MixedPixels(benchmark::State& state) {
  const Sweep& sweep = TheStreet().sweep;
  const auto reducer = MakeReducer(test::MethodOptions(MatchMethod::kNdt), {});
  std::size_t num_left = 0;
  for (int i = 0; i < 10; ++i) num_left = reducer->Reduce(sweep).points.size();
  const std::size_t stride = sweep.points.size() / num_left;
  MixedPixelFinder finder;
  int num_found = 0;
  for (auto _ : state) {
    finder.Load(sweep);
    num_found = 0;
    for (std::size_t i = 0; i < sweep.points.size(); i += stride) {
      num_found += finder.IsMixed(static_cast<std::uint32_t>(i)) ? 1 : 0;
    }
    benchmark::DoNotOptimize(num_found);
  }
  state.counters["judged"] = static_cast<double>(sweep.points.size() / stride);
  state.counters["found"] = num_found;
}

void BM_Match(benchmark::State& state) {
  test::MethodBench bench = MakeBench(static_cast<MatchMethod>(state.range(0)));
  const Street& street = TheStreet();
  const test::MethodScan scan = bench.Reduce(street.sweep);
  Vector6 offset;  // one sigma of a guess that an IMU carried over one sweep
  offset << 0.01, -0.01, 0.01, 0.001, 0.001, -0.001;
  MatchResult result;
  for (auto _ : state) {
    result = bench.Match(scan, street.truth * ExpSe3(offset), test::GuessCov(0.01, 0.001));
  }
  state.counters["matched"] = result.num_matched;
  state.counters["iterations"] = result.iterations;
  state.counters["error_mm"] = 1e3 * (street.truth.Inverse() * result.T_map_imu).translation.norm();
}

void BM_Insert(benchmark::State& state) {
  test::MethodBench bench = MakeBench(static_cast<MatchMethod>(state.range(0)));
  const test::MethodScan scan = bench.Reduce(TheStreet().sweep);
  double x = 5.0;  // each insertion has another place, so that it is a keyframe
  for (auto _ : state) bench.Insert(scan, test::SensorAt(x += 1.5, 0));
  state.counters["cells"] = static_cast<double>(bench.matcher().map_size().num_cells);
}

void EachMethod(benchmark::internal::Benchmark* bench) {
  bench->ArgName("method");
  for (const MatchMethod method : {MatchMethod::kNdt, MatchMethod::kLoam, MatchMethod::kGicp}) {
    bench->Arg(static_cast<int>(method));
  }
  bench->Unit(benchmark::kMillisecond);
}

BENCHMARK(BM_Reduce)->Apply(EachMethod);
BENCHMARK(BM_MixedPixels)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Match)->Apply(EachMethod);
BENCHMARK(BM_Insert)->Apply(EachMethod);

}  // namespace
}  // namespace lio
