// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Measures the time of the filter's parts: one inertial step with its covariance, one pose update,
// a replay of 100 ms at 400 Hz after a late pose, and a start in motion. Quote medians:
//   lio-bench-filter --benchmark_repetitions=9 --benchmark_report_aggregates_only=true
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>

#include "lio/filter/filter_history.hpp"
#include "lio/imu/moving_start.hpp"

namespace lio {
namespace {

const Vector3 kG(0, 0, -9.80665);

Timestamp At(double t_s) {
  return Timestamp{} + Duration::FromSeconds(t_s);
}

ImuSample SampleAt(double t_s) {
  ImuSample sample;
  sample.stamp = At(t_s);
  sample.w_imu_radps = {0.1 * std::sin(3 * t_s), 0.05 * std::cos(2 * t_s), 0.3};
  sample.f_imu_mps2 = {0.5 * std::cos(t_s), 0.3, 9.81 + 0.4 * std::sin(9 * t_s)};
  return sample;
}

ProcessNoise Noise() {
  return {1e-3, 2e-3, 2e-5, 2e-4};
}

Estimate Start() {
  Estimate estimate;
  estimate.stamp = At(0);
  estimate.state.v_world_imu = {8, 1, 0};
  estimate.cov.diagonal().setConstant(1e-4);
  estimate.cov.block<6, 6>(kMapPose, kMapPose).setZero();
  return estimate;
}

PoseEvent EventFor(const Estimate& estimate) {
  PoseEvent event;
  event.measurement.T_map_imu = estimate.state.T_map_imu * ExpSe3(Vector6::Constant(1e-3));
  event.measurement.cov = 1e-5 * Matrix6::Identity();
  event.measurement.new_content_share = 0.1;
  event.measurement.blend_cov = 1e-6 * Matrix6::Identity();
  return event;
}

void OneInertialStep(benchmark::State& state) {
  Estimate estimate = Start();
  const ImuSample a = SampleAt(0.0);
  const ImuSample b = SampleAt(0.0025);
  for (auto _ : state) {
    Propagate(estimate, a, b, Noise(), kG);
    benchmark::DoNotOptimize(estimate.cov.data());
  }
}
BENCHMARK(OneInertialStep);

void OnePoseUpdate(benchmark::State& state) {
  Estimate moved = Start();
  for (int i = 0; i < 40; ++i) {
    Propagate(moved, SampleAt(0.0025 * i), SampleAt(0.0025 * (i + 1)), Noise(), kG);
  }
  const PoseEvent event = EventFor(moved);
  for (auto _ : state) {
    Estimate estimate = moved;
    const UpdateResult result = FusePose(estimate, event.measurement, 1e9);
    BlendMapPose(estimate, event.measurement);
    benchmark::DoNotOptimize(result.nis);
    benchmark::DoNotOptimize(estimate.cov.data());
  }
}
BENCHMARK(OnePoseUpdate);

// A pose that is 100 ms late at 400 Hz takes an insertion, an update and a replay of 40 steps. One
// history is used throughout, as in the daemon: a fresh copy for every pose would add page faults
// and cold caches, four times as much as the work itself.
void ReplayOf100Ms(benchmark::State& state) {
  using Clock = std::chrono::steady_clock;
  FilterHistory history({Noise(), kG}, Start(), SampleAt(0));
  int num_samples = 0;
  const auto drive_on = [&](int num) {
    for (int i = 0; i < num; ++i) (void)history.AddImu(SampleAt(0.0025 * ++num_samples));
  };
  drive_on(800);
  for (auto _ : state) {
    drive_on(40);
    // The pose is between two samples, 40 before the newest.
    const Timestamp at = At(0.0025 * (num_samples - 40)) + Duration{1000};
    const PoseEvent event = EventFor(history.At(at));
    const Clock::time_point begin = Clock::now();
    benchmark::DoNotOptimize(history.AddPose(at, event));
    state.SetIterationTime(std::chrono::duration<double>(Clock::now() - begin).count());
  }
}
BENCHMARK(ReplayOf100Ms)->Unit(benchmark::kMicrosecond)->UseManualTime();

void StartInMotion(benchmark::State& state) {
  Rig rig;
  std::vector<ImuSample> samples;
  Estimate estimate = Start();
  std::vector<MatchedPose> poses;
  for (int i = 0; i <= 400; ++i) {  // 2 s at 200 Hz
    samples.push_back(SampleAt(0.005 * i));
    if (i > 0)
      estimate.state =
          PropagateState(estimate.state, samples[samples.size() - 2], samples.back(), kG);
    if (i > 0 && i % 20 == 0) {
      poses.push_back(
          {samples.back().stamp, estimate.state.T_world_imu, 1e-6 * Matrix6::Identity()});
    }
  }
  for (auto _ : state) {
    const MovingStart start = StartMoving(samples, poses, At(0), rig, true);
    if (!start.start) state.SkipWithError(start.why_not.c_str());
    benchmark::DoNotOptimize(&start);
  }
}
BENCHMARK(StartInMotion)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lio

BENCHMARK_MAIN();
