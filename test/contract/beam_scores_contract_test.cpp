// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the promises of every registration method about its scores by beam direction.
#include <gtest/gtest.h>

#include <cmath>

#include "lio/registration/beam_scores.hpp"
#include "pipeline/sensor_fixed_errors.hpp"
#include "support/matcher_drive.hpp"

namespace lio {
namespace {

using test::CastTurn;
using test::DriveSweeps;
using test::GrowMap;
using test::GuessCov;
using test::kTruth;
using test::Lidar;
using test::MethodBench;
using test::MethodScan;
using test::RayScene;
using test::SensorAt;

class MatcherBeamScores : public testing::TestWithParam<MatchMethod> {};

TEST_P(MatcherBeamScores, CountOnceByElevationAndOnceByOctant) {
  const RayScene scene = test::StreetScene();
  MethodBench bench(GetParam());
  GrowMap(bench, DriveSweeps(scene, 0.01));
  const MethodScan scan = bench.Reduce(CastTurn(scene, Lidar(0.01, 0.31), kTruth, 3).sweep);
  const auto scores = bench.Match(scan, kTruth, GuessCov(0.02, 0.002)).beam_pull.scores;
  ASSERT_EQ(scores.size(), BeamScores::kNumDirections);
  Vector6 by_elevation = Vector6::Zero();
  Vector6 by_octant = Vector6::Zero();
  double size = 0.0;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    (i < BeamScores::kElevations ? by_elevation : by_octant) += scores[i];
    size += scores[i].norm();
  }
  EXPECT_GT(size, 0.0);
  EXPECT_LT((by_elevation - by_octant).norm(), 1e-4 * size);
}

// Lets each ring read too long or too short by the same amount.
void BiasRings(double bias_m, Sweep& sweep) {
  for (LidarPoint& point : sweep.points) {
    const double range_m = std::hypot(point.x_m, point.y_m, point.z_m);
    const bool is_long = point.ring % 3 == 0;
    const auto factor = static_cast<float>(1.0 + (is_long ? bias_m : -bias_m) / range_m);
    for (float* coordinate : {&point.x_m, &point.y_m, &point.z_m}) *coordinate *= factor;
  }
}

// The same biases in map and scans show in matches from other places than the map was seen from.
TEST(NdtScores, BiasesOfRingsShowInTheirMeanOverManyScans) {
  const RayScene scene = test::StreetScene();
  const auto std_m = [&](double bias_m) {
    MethodBench bench(MatchMethod::kNdt);
    std::vector<Sweep> sweeps = DriveSweeps(scene, 0.01);
    for (Sweep& sweep : sweeps) BiasRings(bias_m, sweep);
    GrowMap(bench, sweeps);
    SensorFixedErrors errors;
    MatchResult match;
    for (int i = 0; i < 30; ++i) {
      const Pose pose = SensorAt(2.5 + 0.05 * i, 0.21, 0.03);
      const auto seed = static_cast<std::uint32_t>(i);
      Sweep sweep = CastTurn(scene, Lidar(0.01, 0.31 + 0.01 * i), pose, seed).sweep;
      BiasRings(bias_m, sweep);
      match = bench.Match(bench.Reduce(sweep), pose, GuessCov(0.02, 0.002));
      errors.Add(match);
    }
    return std::sqrt(errors.CovPerReplacement(match).topLeftCorner<3, 3>().trace());
  };
  EXPECT_GT(std_m(0.02), 3.0 * std_m(0.0));
}

INSTANTIATE_TEST_SUITE_P(Methods, MatcherBeamScores,
                         testing::Values(MatchMethod::kNdt, MatchMethod::kLoam, MatchMethod::kGicp),
                         test::NameOfMethod);

}  // namespace
}  // namespace lio
