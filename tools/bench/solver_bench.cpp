// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Compares LOAM's pose problem in Ceres with analytic and with automatic derivatives, on as many
// terms as a sweep gives.
#include <benchmark/benchmark.h>

#include <random>

#include "registration/loam_solver.hpp"

namespace lio {
namespace {

constexpr int kNumPlanes = 1600;
constexpr int kNumEdges = 300;

// Adds points of planes and lines in every direction, seen from a pose near `start`.
void Fill(LoamSolver& solver, double s) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0.0, 1.0);
  const auto vector = [&](double size) -> Vector3 {
    return size * Vector3{normal(random), normal(random), normal(random)};
  };
  const Pose truth{ExpSo3(Vector3(0.002, 0.001, -0.003)), Vector3(0.02, -0.01, 0.01)};
  for (int i = 0; i < kNumPlanes; ++i) {
    const Vector3 point = vector(15.0);
    const Vector3 n = vector(1.0).normalized();
    solver.AddPlane(point, n, -n.dot(truth * point) + 0.02 * normal(random), s);
  }
  for (int i = 0; i < kNumEdges; ++i) {
    const Vector3 point = vector(15.0);
    const Vector3 on_line = truth * point + vector(0.03);
    solver.AddEdge(point, on_line, on_line + vector(1.0).normalized(), s);
  }
}

void BM_Solve(benchmark::State& state) {
  const double s = state.range(0) == 1 ? 1.0 : 0.999999;  // below 1: automatic
  LoamSolver solver;
  Fill(solver, s);
  LoamSolverOptions options;
  options.edge_weight = 0.1;
  for (auto _ : state) benchmark::DoNotOptimize(solver.Solve(Pose::Identity(), options));
}

BENCHMARK(BM_Solve)->ArgName("analytic")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lio
