// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/loam_scan_matcher.hpp"

#include <gtest/gtest.h>

#include "lio/scan/loam_reducer.hpp"
#include "support/street_scene.hpp"

namespace lio {
namespace {

using test::CastTurn;
using test::SensorAt;

struct Scan {
  std::vector<Eigen::Vector3f> points;
  std::vector<FeatureTag> tags;
  std::vector<float> ratios;  // share of the sweep's time

  MatchInput InputFor(const Pose& guess, double std_m, double std_rad) const {
    Vector6 variance;
    variance << Vector3::Constant(std_m * std_m), Vector3::Constant(std_rad * std_rad);
    return {points, guess, variance.asDiagonal(), false, tags};
  }
};

Scan Reduce(const Sweep& sweep) {
  LoamReducer reducer({}, {}, {}, {});
  const ReducedScan reduced = reducer.Reduce(sweep);
  Scan scan;
  scan.tags = reduced.tags;
  for (const ScanPoint& point : reduced.points) {
    scan.points.push_back(point.position);
    scan.ratios.push_back(static_cast<float>(point.t_offset_ns) /
                          static_cast<float>((sweep.end - sweep.start).ns));
  }
  return scan;
}

class LoamScanMatching : public testing::Test {
 protected:
  // The previous scan was taken at rest at `T_world_last_`.
  void InsertFirst(const Pose& T_map_last) {
    const Scan first = Reduce(CastTurn(scene_, lidar_, T_world_last_).sweep);
    matcher_.Insert({first.points, first.tags}, T_map_last);
  }

  test::RayScene scene_ = test::StreetScene();
  test::SpinningLidar lidar_ = test::SpinningLidar::Hdl32e();
  Pose T_world_last_ = SensorAt(0, 0.3, 0.1);
  LoamScanMatcher matcher_{LoamOptions{}};
};

TEST_F(LoamScanMatching, FindsTheMotionBetweenTwoScans) {
  const Pose T_map_last{ExpSo3(Vector3(0, 0, 1.0)), Vector3(100, -50, 3)};
  InsertFirst(T_map_last);
  const Pose motion{ExpSo3(Vector3(0.005, -0.01, 0.03)), Vector3(0.6, 0.05, 0.01)};
  lidar_.start_azimuth_rad = 0.4;
  const Scan scan = Reduce(CastTurn(scene_, lidar_, T_world_last_ * motion).sweep);
  const MatchResult result = matcher_.Match(scan.InputFor(T_map_last, 0.4, 0.03));
  EXPECT_EQ(result.status, MatchStatus::kConverged);
  EXPECT_EQ(result.new_content_share, 1.0);
  const Pose error = (T_map_last * motion).Inverse() * result.T_map_imu;
  EXPECT_LT(error.translation.norm(), 0.02);
  EXPECT_LT(LogSo3(error.rotation).norm(), 0.004);
}

// A scan whose points all have the whole motion is a rigid one.
TEST_F(LoamScanMatching, CovarianceIsThatOfTheLastStepAlone) {
  InsertFirst(Pose::Identity());
  const Pose motion{ExpSo3(Vector3(0.01, -0.01, 0.04)), Vector3(0.6, -0.2, 0.02)};
  const Scan scan = Reduce(CastTurn(scene_, lidar_, T_world_last_ * motion).sweep);
  const MatchInput input = scan.InputFor(Pose::Identity(), 0.4, 0.03);
  const std::vector<float> whole(scan.ratios.size(), 1.f);
  const MatchResult rigid = matcher_.Match(input);
  const MatchResult skewed = matcher_.MatchSkewed(input, whole);
  ASSERT_TRUE(rigid.IsUsable() && skewed.IsUsable());
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(rigid.cov(i, i) / skewed.cov(i, i), 1.0, 0.2) << i;
}

TEST_F(LoamScanMatching, SweepRatiosTakeTheDistortionIntoAccount) {
  InsertFirst(Pose::Identity());
  const Pose motion{ExpSo3(Vector3(0, 0, 0.06)), Vector3(0.8, 0, 0)};  // during the sweep
  const auto T_world_lidar = [&](double share) {
    return T_world_last_ * Interpolate(Pose::Identity(), motion, share);
  };
  const Scan scan = Reduce(CastTurn(scene_, lidar_, T_world_lidar).sweep);
  const MatchInput input = scan.InputFor(Pose::Identity(), 0.5, 0.05);
  const MatchResult skewed = matcher_.MatchSkewed(input, scan.ratios);
  const MatchResult rigid = matcher_.Match(input);
  const double error = (motion.Inverse() * skewed.T_map_imu).translation.norm();
  EXPECT_LT(error, 0.05);
  EXPECT_LT(LogSo3((motion.Inverse() * skewed.T_map_imu).rotation).norm(), 0.005);
  EXPECT_GT((motion.Inverse() * rigid.T_map_imu).translation.norm(), 4.0 * error);
}

TEST_F(LoamScanMatching, OnlyTheLastScanIsKept) {
  InsertFirst(Pose::Identity());
  const std::size_t before = matcher_.map_size().num_cells;
  for (int i = 0; i < 3; ++i) InsertFirst(Pose::Identity());
  EXPECT_EQ(matcher_.map_size().num_cells, before);
  matcher_.Clear();
  const Scan scan = Reduce(CastTurn(scene_, lidar_, T_world_last_).sweep);
  EXPECT_EQ(matcher_.Match(scan.InputFor(Pose::Identity(), 0.1, 0.01)).status,
            MatchStatus::kEmptyMap);
}

TEST_F(LoamScanMatching, CorridorIsDegenerateAlongItsAxis) {
  scene_ = test::CorridorScene();
  lidar_.range_std_m = 0.01;
  InsertFirst(Pose::Identity());
  const Scan scan = Reduce(CastTurn(scene_, lidar_, T_world_last_, 3).sweep);
  const MatchResult result = matcher_.Match(scan.InputFor(Pose::Identity(), 0.05, 0.01));
  EXPECT_EQ(result.status, MatchStatus::kDegenerate);
  const Vector3 axis = T_world_last_.rotation.conjugate() * Vector3::UnitX();
  EXPECT_GT(axis.dot(result.cov.topLeftCorner<3, 3>() * axis), 2500.0);
}

TEST_F(LoamScanMatching, PointsWithoutTagsAreACallersMistake) {
  InsertFirst(Pose::Identity());
  const std::vector<Eigen::Vector3f> points(3, Eigen::Vector3f::Ones());
  EXPECT_THROW(matcher_.Insert({points}, Pose::Identity()), std::invalid_argument);
  EXPECT_THROW((void)matcher_.Match({points, Pose::Identity()}), std::invalid_argument);
}

}  // namespace
}  // namespace lio
