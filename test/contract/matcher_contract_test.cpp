// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the promises of every registration method.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "support/matcher_drive.hpp"

namespace lio {
namespace {

using test::CastTurn;
using test::DrivePose;
using test::DriveSweeps;
using test::GrowMap;
using test::GuessCov;
using test::kNumMapScans;
using test::kTruth;
using test::Lidar;
using test::MethodBench;
using test::MethodScan;
using test::Moved;
using test::RayScene;
using test::SensorAt;
using test::StreetSweeps;

constexpr double kDegree = std::numbers::pi / 180.0;

Vector6 Tangent(double x, double y, double z, double roll, double pitch, double yaw) {
  Vector6 tangent;
  tangent << x, y, z, roll, pitch, yaw;
  return tangent;
}

struct Error {
  double translation_m;
  double rotation_deg;
};

Error ErrorOf(const Pose& estimate, const Pose& truth) {
  const Pose difference = truth.Inverse() * estimate;
  return {difference.translation.norm(), LogSo3(difference.rotation).norm() / kDegree};
}

void ExpectConverged(const MatchResult& result) {
  EXPECT_EQ(result.status, MatchStatus::kConverged);
  EXPECT_EQ(result.degenerate_mask, 0u);
  EXPECT_TRUE(result.information.allFinite());
  EXPECT_TRUE(result.cov.allFinite());
}

class MatcherContract : public testing::TestWithParam<MatchMethod> {};

TEST_P(MatcherContract, RecoversOffsetsUpToAMetreAndFiveDegrees) {
  const RayScene scene = test::StreetScene();
  MethodBench bench(GetParam());
  GrowMap(bench, StreetSweeps(0.02));
  const MethodScan scan = bench.Reduce(CastTurn(scene, Lidar(0.02, 0.3), kTruth, 7).sweep);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  constexpr int kNumOffsets = 12;
  for (int i = 1; i <= kNumOffsets; ++i) {
    const double size = static_cast<double>(i) / kNumOffsets;
    const Vector3 shift = {uniform(random), uniform(random), 0.3 * uniform(random)};
    const Vector3 turn = {0.3 * uniform(random), 0.3 * uniform(random), uniform(random)};
    Vector6 offset;
    offset << size * shift.normalized(), size * 5.0 * kDegree * turn.normalized();
    const MatchResult result =
        bench.Match(scan, kTruth * ExpSe3(offset), GuessCov(0.6, 3.0 * kDegree));
    ExpectConverged(result);
    const Error error = ErrorOf(result.T_map_imu, kTruth);
    EXPECT_LT(error.translation_m, 0.02) << "from " << offset.transpose();
    EXPECT_LT(error.rotation_deg, 0.1) << "from " << offset.transpose();
  }
}

TEST_P(MatcherContract, IsExactOnTheSameCloudMoved) {
  MethodBench bench(GetParam());
  const MethodScan scan =
      bench.Reduce(CastTurn(test::StreetScene(), Lidar(), SensorAt(0, 0)).sweep);
  bench.Insert(scan, Pose::Identity());
  for (const Vector6& offset : {Tangent(0.2, -0.1, 0.05, 0.01, -0.01, 0.03),
                                Tangent(-0.1, 0.15, -0.05, -0.01, 0.02, -0.02)}) {
    const Pose truth = ExpSe3(offset);
    const MatchResult result =
        bench.Match(Moved(scan, truth), Pose::Identity(), GuessCov(0.15, 1.5 * kDegree));
    const Error error = ErrorOf(result.T_map_imu, truth);
    EXPECT_LT(error.translation_m, 1e-3);
    EXPECT_LT(error.rotation_deg, 0.01);
  }
}

TEST_P(MatcherContract, IsRightOnAnotherSamplingOfTheSameSurfaces) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const RayScene scene = test::StreetScene(seed);
    MethodBench bench(GetParam());
    GrowMap(bench, StreetSweeps(0.0, seed));
    const MethodScan scan = bench.Reduce(CastTurn(scene, Lidar(0.0, 0.31), kTruth).sweep);
    const Pose guess = kTruth * ExpSe3(Tangent(0.03, -0.02, 0.01, 0.002, 0.001, -0.003));
    const MatchResult result = bench.Match(scan, guess, GuessCov(0.03, 0.2 * kDegree));
    ExpectConverged(result);
    const Error error = ErrorOf(result.T_map_imu, kTruth);
    EXPECT_LT(error.translation_m, 0.01) << "street " << seed;
    EXPECT_LT(error.rotation_deg, 0.05) << "street " << seed;
  }
}

TEST_P(MatcherContract, SaysThatACorridorDoesNotHoldItsAxis) {
  const RayScene scene = test::CorridorScene();
  MethodBench bench(GetParam());
  GrowMap(bench, DriveSweeps(scene, 0.02));
  const MethodScan scan = bench.Reduce(CastTurn(scene, Lidar(0.02, 0.3), kTruth, 9).sweep);
  const Vector3 axis = kTruth.rotation.conjugate() * Vector3::UnitX();
  Vector6 offset = Tangent(0.0, 0.03, 0.02, 0.002, 0.002, 0.005);
  offset.head<3>() += 0.1 * axis;
  const MatchResult result =
      bench.Match(scan, kTruth * ExpSe3(offset), GuessCov(0.1, 0.5 * kDegree));
  EXPECT_EQ(result.status, MatchStatus::kDegenerate);
  EXPECT_NE(result.degenerate_mask, 0u);
  // The step along the axis is zero, the variance huge along it and small across.
  const Vector3 across = kTruth.rotation.conjugate() * Vector3::UnitY();
  const Matrix3 position_cov = result.cov.topLeftCorner<3, 3>();
  EXPECT_GT(axis.dot(position_cov * axis), 50.0 * 50.0);
  EXPECT_LT(across.dot(position_cov * across), 1.0);
  const Vector3 error = (kTruth.Inverse() * result.T_map_imu).translation;
  EXPECT_NEAR(axis.dot(error), 0.1, 0.02);
  EXPECT_LT((error - axis.dot(error) * axis).norm(), 0.01);
}

TEST_P(MatcherContract, SaysThatTheMapIsEmpty) {
  MethodBench bench(GetParam());
  const MethodScan scan = bench.Reduce(CastTurn(test::StreetScene(), Lidar(), kTruth).sweep);
  const Pose guess = SensorAt(3, 4, 0.5);
  const MatchResult result = bench.Match(scan, guess, GuessCov(0.1, 0.01));
  EXPECT_EQ(result.status, MatchStatus::kEmptyMap);
  EXPECT_EQ(result.T_map_imu.translation, guess.translation);
  EXPECT_FALSE(result.IsUsable());
  EXPECT_EQ(bench.matcher().map_size().num_cells, 0u);
}

TEST_P(MatcherContract, SaysThatAScanIsTooSmallOrElsewhere) {
  const RayScene scene = test::StreetScene();
  MethodBench bench(GetParam());
  GrowMap(bench, StreetSweeps(0.0));
  MethodScan scan = bench.Reduce(CastTurn(scene, Lidar(), kTruth).sweep);
  const MatchResult elsewhere = bench.Match(scan, SensorAt(5000, 0), GuessCov(0.1, 0.01));
  EXPECT_EQ(elsewhere.status, MatchStatus::kTooFewPoints);
  EXPECT_FALSE(elsewhere.IsUsable());
  for (const std::size_t count : {10, 0}) {
    scan.to_match.resize(count);
    if (!scan.to_match_tags.empty()) scan.to_match_tags.resize(count);
    const MatchResult result = bench.Match(scan, kTruth, GuessCov(0.1, 0.01));
    EXPECT_EQ(result.status, MatchStatus::kTooFewPoints);
  }
}

TEST_P(MatcherContract, ForgetsItsMapWhenToldTo) {
  MethodBench bench(GetParam());
  const MethodScan scan = bench.Reduce(CastTurn(test::StreetScene(), Lidar(), kTruth).sweep);
  bench.Insert(scan, kTruth);
  EXPECT_GT(bench.matcher().map_size().num_cells, 0u);
  EXPECT_GT(bench.matcher().map_size().memory_bytes, 0u);
  bench.matcher().Clear();
  EXPECT_EQ(bench.matcher().map_size().num_cells, 0u);
  EXPECT_EQ(bench.Match(scan, kTruth, GuessCov(0.1, 0.01)).status, MatchStatus::kEmptyMap);
}

TEST_P(MatcherContract, DoesNotDependOnTheOrderOfPoints) {
  const RayScene scene = test::StreetScene();
  std::vector<Sweep> sweeps = StreetSweeps(0.02);
  Sweep sweep = CastTurn(scene, Lidar(0.02), kTruth, 7).sweep;
  const Pose guess = kTruth * ExpSe3(Tangent(0.03, -0.02, 0.01, 0.002, 0.001, -0.003));
  std::vector<MatchResult> results;
  for (int i = 0; i < 2; ++i) {
    MethodBench bench(GetParam());
    GrowMap(bench, sweeps);
    results.push_back(bench.Match(bench.Reduce(sweep), guess, GuessCov(0.03, 0.003)));
    std::mt19937 random(3);
    for (Sweep& each : sweeps) std::shuffle(each.points.begin(), each.points.end(), random);
    std::shuffle(sweep.points.begin(), sweep.points.end(), random);
  }
  // The results are equal to the last bit.
  EXPECT_EQ(results[0].T_map_imu.translation, results[1].T_map_imu.translation);
  EXPECT_EQ(results[0].T_map_imu.rotation.coeffs(), results[1].T_map_imu.rotation.coeffs());
  EXPECT_EQ(results[0].cov, results[1].cov);
}

TEST_P(MatcherContract, DoesNotDependOnTheNumberOfThreads) {
  const RayScene scene = test::StreetScene();
  const std::vector<Sweep>& sweeps = StreetSweeps(0.02);
  const Sweep sweep = CastTurn(scene, Lidar(0.02), kTruth, 7).sweep;
  const Pose guess = kTruth * ExpSe3(Tangent(0.03, -0.02, 0.01, 0.002, 0.001, -0.003));
  const auto match_with = [&](int num_threads) {
    Options options = test::MethodOptions(GetParam());
    options.pipeline.num_threads = num_threads;
    MethodBench bench(options);
    GrowMap(bench, sweeps);
    return bench.Match(bench.Reduce(sweep), guess, GuessCov(0.03, 0.003));
  };
  const MatchResult alone = match_with(1);
  for (const int num_threads : {2, 3}) {
    const MatchResult together = match_with(num_threads);  // to the last bit
    EXPECT_EQ(together.T_map_imu.translation, alone.T_map_imu.translation) << num_threads;
    EXPECT_EQ(together.T_map_imu.rotation.coeffs(), alone.T_map_imu.rotation.coeffs());
    EXPECT_EQ(together.cov, alone.cov);
    EXPECT_EQ(together.information, alone.information);
    EXPECT_EQ(together.new_content_share, alone.new_content_share);
    EXPECT_EQ(together.num_matched, alone.num_matched);
  }
}

TEST_P(MatcherContract, InformationIsTheCurvatureOfItsCost) {
  const RayScene scene = test::StreetScene();
  MethodBench bench(GetParam());
  GrowMap(bench, StreetSweeps(0.0));  // no noise: small residuals
  const MethodScan scan = bench.Reduce(CastTurn(scene, Lidar(0.0, 0.31), kTruth).sweep);
  const MatchInput input = MethodBench::InputFor(scan, kTruth, GuessCov(0.01, 0.001));
  const MatchResult result = bench.matcher().Match(input);
  ExpectConverged(result);
  const auto cost = [&](const Vector6& d) {
    return bench.diagnostics().FixedCorrespondenceCost(input, result.T_map_imu * ExpSe3(d));
  };
  Vector6 step;
  step << Vector3::Constant(1e-3), Vector3::Constant(1e-4);
  Matrix6 numeric;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const Vector6 a = step[i] * Vector6::Unit(i);
      const Vector6 b = step[j] * Vector6::Unit(j);
      numeric(i, j) =
          (cost(a + b) - cost(a - b) - cost(b - a) + cost(-a - b)) / (4.0 * step[i] * step[j]);
    }
  }
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const double scale = std::sqrt(numeric(i, i) * numeric(j, j));
      EXPECT_NEAR(result.information(i, j), numeric(i, j), 0.02 * scale) << i << ", " << j;
    }
  }
}

// The draws are of the scan's noise; the map is one.
TEST_P(MatcherContract, CovarianceAgreesWithMonteCarlo) {
  const RayScene scene = test::StreetScene(2);
  MethodBench bench(GetParam());
  GrowMap(bench, StreetSweeps(0.0, 2));
  const Sweep exact = CastTurn(scene, Lidar(0.0, 0.31), kTruth).sweep;
  constexpr int kNumDraws = 60;
  std::mt19937 random(1);
  std::normal_distribution<float> noise_m(0.f, 0.02f);
  std::vector<Vector6> errors;
  Matrix6 predicted = Matrix6::Zero();
  Vector6 mean = Vector6::Zero();
  for (int i = 0; i < kNumDraws; ++i) {
    Sweep sweep = exact;
    for (LidarPoint& point : sweep.points) {
      const float range = std::hypot(point.x_m, point.y_m, point.z_m);
      const float scale = 1.f + noise_m(random) / range;
      point.x_m *= scale;
      point.y_m *= scale;
      point.z_m *= scale;
    }
    const MatchResult result = bench.Match(bench.Reduce(sweep), kTruth, GuessCov(0.01, 0.001));
    ExpectConverged(result);
    errors.push_back(LogSe3(kTruth.Inverse() * result.T_map_imu));
    mean += errors.back() / kNumDraws;
    predicted += result.cov / kNumDraws;
  }
  double ratio = 0.0;  // 1 when the covariance is that of the draws
  for (const Vector6& error : errors) {
    ratio += (error - mean).dot(predicted.inverse() * (error - mean)) / 6.0 / (kNumDraws - 1);
  }
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 1.5);
}

TEST_P(MatcherContract, ShareOfNewContentFallsAsThePlaceBecomesKnown) {
  const RayScene scene = test::StreetScene();
  MethodBench bench(GetParam());
  bench.Insert(bench.Reduce(CastTurn(scene, Lidar(), SensorAt(0, 0)).sweep), SensorAt(0, 0));
  const auto share = [&] {
    const Pose pose = SensorAt(3.5, 0.1, 0.01);  // far enough for a keyframe
    const MethodScan scan = bench.Reduce(CastTurn(scene, Lidar(), pose).sweep);
    return bench.Match(scan, pose, GuessCov(0.02, 0.002)).new_content_share;
  };
  const double at_first = share();
  GrowMap(bench, StreetSweeps(0.0));
  const double later = share();
  EXPECT_GT(at_first, 0.05);
  EXPECT_LE(at_first, 1.0);
  EXPECT_LT(later, at_first);
  EXPECT_GE(later, 0.0);
}

TEST_P(MatcherContract, MapStaysBounded) {
  Options options = test::MethodOptions(GetParam());
  options.ndt.max_cells = 2000;
  options.loam.max_leaves = 1000;  // in each of two maps
  options.gicp.max_points = 12000;
  const std::size_t limit = GetParam() == MatchMethod::kGicp ? 12000 : 2000;
  MethodBench bench(options);
  const RayScene scene = test::StreetScene();
  for (int i = 0; i < 12; ++i) {
    const Pose pose = SensorAt(-30.0 + 5.0 * i, 0);
    bench.Insert(bench.Reduce(CastTurn(scene, Lidar(), pose).sweep), pose);
    ASSERT_LE(bench.matcher().map_size().num_cells, limit);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, MatcherContract,
                         testing::Values(MatchMethod::kNdt, MatchMethod::kLoam, MatchMethod::kGicp),
                         test::NameOfMethod);

}  // namespace
}  // namespace lio
