// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/ndt_matcher.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "registration/ndt_matcher_in.hpp"
#include "support/random_state.hpp"

namespace lio {
namespace {

using test::ErrorOf;
using test::NdtMatcherIn;
using test::OnRoad;
using test::Points;

// The standard deviations are the given one in translation, and a twentieth of it in rotation
// [rad].
Vector6 DrawGuessError(std::mt19937_64& random, double std) {
  Vector6 error = std * test::RandomVector<6>(random);
  error.tail<3>() *= 0.05;
  return error;
}

// A turn of 46 deg/s that the guess did not know: a rigid scan is bent by 2.3 deg either way.
TEST(NdtMatcher, AScanBendsAlongWithThePose) {
  NdtMatcherIn scene(test::Street());
  scene.InsertRoad(-3.0, 3.0);
  const Pose truth = OnRoad(0.0);
  const auto off_rad = [&](bool bends) {
    const MatchResult match = scene.MatchBent(truth, 0.08, bends);
    EXPECT_TRUE(match.IsUsable()) << bends;
    return LogSo3(truth.rotation.conjugate() * match.T_map_imu.rotation).norm();
  };
  EXPECT_LT(off_rad(true), 0.003);
  EXPECT_GT(off_rad(false), 0.02);
}

TEST(NdtMatcher, RecoversKnownOffsetsOnAStreet) {
  NdtMatcherIn street(test::Street());
  street.InsertRoad(0.0, 20.0);
  const Pose truth = OnRoad(12.4);
  for (int i = 0; i < 10; ++i) {
    const Vector6 guess_error = DrawGuessError(street.random(), 0.2);
    const MatchResult result = street.MatchFrom(truth, guess_error, 0.2);
    ASSERT_EQ(result.status, MatchStatus::kConverged) << guess_error.transpose();
    const Vector6 error = ErrorOf(result, truth);
    EXPECT_LT(error.head<3>().norm(), 0.01) << guess_error.transpose();
    EXPECT_LT(error.tail<3>().norm(), 1e-3) << guess_error.transpose();
    EXPECT_EQ(result.degenerate_mask, 0u);
    EXPECT_LT(result.residual_rms_m, 0.05);
    EXPECT_GT(result.num_matched, 2000);
  }
}

// Makes a closed room of 3.2 by 2.4 m around the origin.
test::Scene Closet() {
  return {-1.0,
          {{Vector3(1.7, 0, 0), Vector3(0.1, 1.4, 3), 0.0},
           {Vector3(-1.7, 0, 0), Vector3(0.1, 1.4, 3), 0.0},
           {Vector3(0, 1.3, 0), Vector3(1.8, 0.1, 3), 0.0},
           {Vector3(0, -1.3, 0), Vector3(1.8, 0.1, 3), 0.0}}};
}

TEST(NdtMatcher, PointsOnWhatStandsAreCountedApartFromTheRoads) {
  NdtMatcherIn street(test::Street());
  street.matcher().SetUp(Vector3::UnitZ());
  street.InsertRoad(0.0, 20.0);
  const Pose truth = OnRoad(12.4);
  const Points points = street.See(truth);
  const auto num_on_road = std::ranges::count_if(points, [&](const Eigen::Vector3f& point) {
    return (truth * point.cast<double>()).z() < -0.8;
  });
  const MatchResult result = street.Match(points, truth, 0.02);
  const auto num_standing = static_cast<int>(std::ssize(points) - num_on_road);
  EXPECT_NEAR(result.upright.all.num_matched, num_standing, num_standing / 3);
  EXPECT_GT(10 * result.upright.all.num_matched, 9 * result.upright.all.num_in_map);
  EXPECT_LT(5 * result.upright.all.num_in_map, 4 * result.num_in_map);
}

// Levels are counted by the size of their cells, 0.25, 0.5, 1 and 2 m, of which the second and the
// third are in use where the place is wide.
TEST(NdtMatcher, InAStreetPointsAreMatchedInCellsOfHalfAndOfOneMetre) {
  NdtMatcherIn street(test::Street());
  street.InsertRoad(0.0, 20.0);
  const MatchResult result = street.MatchFrom(OnRoad(12.4), Vector6::Zero(), 0.02);
  ASSERT_TRUE(result.IsUsable());
  const LevelCounts& counts = result.by_level.counts;
  EXPECT_EQ(counts[0], 0);
  EXPECT_GT(counts[1], 1000);
  EXPECT_GT(counts[2], 100);
  EXPECT_EQ(counts[1] + counts[2], result.num_matched);
  EXPECT_EQ(result.by_level.num_in_finest, counts[1]);
}

// Every eighth point of two scans leaves most cells without a surface: those of 2 m help.
TEST(NdtMatcher, WhereFewPointsLieOnSurfacesCellsOfTwoMetresHelp) {
  NdtMatcherIn street(test::Street());
  const auto thinned = [&](double x_m) {
    const Points all = street.See(OnRoad(x_m));
    Points few;
    for (std::size_t i = 0; i < all.size(); i += 8) few.push_back(all[i]);
    return few;
  };
  for (const double x_m : {10.0, 12.0}) street.Insert(thinned(x_m), OnRoad(x_m));
  const MatchResult result = street.Match(thinned(11.4), OnRoad(11.4), 0.02);
  ASSERT_TRUE(result.IsUsable());
  const LevelCounts& counts = result.by_level.counts;
  EXPECT_GT(counts[3], counts[1] + counts[2]);
  EXPECT_EQ(counts[1] + counts[2] + counts[3], result.num_matched);
  EXPECT_LT(ErrorOf(result, OnRoad(11.4)).head<3>().norm(), 0.1);
}

TEST(NdtMatcher, InANarrowPlacePointsAreMatchedInCellsOfAQuarterAndOfHalfAMetre) {
  NdtMatcherIn closet(Closet());
  for (int i = 0; i < 8; ++i) closet.InsertFrom({ExpSo3({0, 0, 0.1 * i}), {0.05 * i, 0, 0.03 * i}});
  const MatchResult result =
      closet.MatchFrom({ExpSo3({0, 0, 0.33}), {0.2, 0.02, 0.1}}, Vector6::Zero(), 0.02);
  ASSERT_TRUE(result.IsUsable());
  const LevelCounts& counts = result.by_level.counts;
  EXPECT_GT(counts[0], 1000);
  EXPECT_EQ(counts[2], 0);
  EXPECT_EQ(counts[0] + counts[1], result.num_matched);
  EXPECT_EQ(result.by_level.num_in_finest, counts[0]);
}

TEST(NdtMatcher, EmptyMapGivesTheGuessAndSaysSo) {
  NdtMatcherIn street(test::Street());
  const MatchResult result = street.MatchFrom(OnRoad(0.0), Vector6::Zero(), 0.1);
  EXPECT_EQ(result.status, MatchStatus::kEmptyMap);
  EXPECT_FALSE(result.IsUsable());
  EXPECT_EQ(LogSe3(OnRoad(0.0).Inverse() * result.T_map_imu).norm(), 0.0);
}

TEST(NdtMatcher, ClearedMapIsEmpty) {
  NdtMatcherIn street(test::Street());
  street.InsertFrom(OnRoad(0.0));
  EXPECT_GT(street.matcher().map_size().num_cells, 100u);
  street.matcher().Clear();
  EXPECT_EQ(street.matcher().map_size().num_cells, 0u);
  EXPECT_EQ(street.MatchFrom(OnRoad(0.0), Vector6::Zero(), 0.1).status, MatchStatus::kEmptyMap);
}

TEST(NdtMatcher, TooFewPointsAreRefused) {
  NdtMatcherIn street(test::Street());
  street.InsertRoad(0.0, 5.0);
  for (const std::size_t num_points : {0u, 1u, 30u}) {
    Points points = street.See(OnRoad(3.0));
    points.resize(num_points);
    const MatchResult result = street.Match(points, OnRoad(3.0), 0.1);
    EXPECT_EQ(result.status, MatchStatus::kTooFewPoints) << num_points;
    EXPECT_FALSE(result.IsUsable());
  }
}

TEST(NdtMatcher, ScanFarFromTheMapIsRefused) {
  NdtMatcherIn street(test::Street());
  street.InsertRoad(0.0, 5.0);
  Pose far = OnRoad(3.0);
  far.translation += Vector3(0.0, 0.0, 500.0);
  EXPECT_EQ(street.Match(street.See(OnRoad(3.0)), far, 0.1).status, MatchStatus::kTooFewPoints);
  far.translation = Vector3(1e9, -1e12, 1e300);
  EXPECT_FALSE(street.Match(street.See(OnRoad(3.0)), far, 0.1).IsUsable());
}

TEST(NdtMatcher, NonFiniteGuessIsRefused) {
  NdtMatcherIn street(test::Street());
  street.InsertRoad(0.0, 5.0);
  Pose broken = OnRoad(3.0);
  broken.translation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(street.Match(street.See(OnRoad(3.0)), broken, 0.1).IsUsable());
}

TEST(NdtMatcher, SameInputGivesTheSameBits) {
  const auto run = [] {
    NdtMatcherIn street(test::Street());
    street.InsertRoad(0.0, 8.0);
    return street.MatchFrom(OnRoad(5.5), 0.1 * Vector6::Unit(0), 0.1);
  };
  const MatchResult a = run();
  const MatchResult b = run();
  EXPECT_EQ(a.T_map_imu.translation, b.T_map_imu.translation);
  EXPECT_EQ(a.T_map_imu.rotation.coeffs(), b.T_map_imu.rotation.coeffs());
  EXPECT_EQ(a.cov, b.cov);
  EXPECT_EQ(a.information, b.information);
  EXPECT_EQ(a.iterations, b.iterations);
}

TEST(NdtMatcher, MatchingTwiceInARowGivesTheSameBits) {
  NdtMatcherIn street(test::Street());
  street.InsertRoad(0.0, 8.0);
  const Points points = street.See(OnRoad(5.5));
  const MatchResult a = street.Match(points, OnRoad(5.4), 0.1);
  (void)street.Match(street.See(OnRoad(2.0)), OnRoad(2.1), 0.1);  // scratch memory is left behind
  const MatchResult b = street.Match(points, OnRoad(5.4), 0.1);
  EXPECT_EQ(a.T_map_imu.translation, b.T_map_imu.translation);
  EXPECT_EQ(a.cov, b.cov);
}

TEST(NdtMatcher, IterationsStayWithinTheLimit) {
  NdtMatcherIn street(test::Street());
  street.InsertRoad(0.0, 8.0);
  NdtOptions options;
  options.max_iterations = 2;  // too few for the radius to shrink
  NdtMatcher hurried(options);
  for (double x = 0.0; x <= 8.0; x += 1.0) hurried.Insert({street.See(OnRoad(x))}, OnRoad(x));
  const Points points = street.See(OnRoad(5.5));
  const MatchResult result = hurried.Match({points, OnRoad(5.2), Matrix6::Identity()});
  EXPECT_EQ(result.status, MatchStatus::kMaxIterations);
  EXPECT_EQ(result.iterations, 2);
  EXPECT_FALSE(result.IsUsable());
}

TEST(NdtMatcher, NewContentShareFallsAsTheMapFills) {
  NdtMatcherIn street(test::Street());
  street.InsertFrom(OnRoad(0.0));
  double last_share = 1.0;
  for (int i = 0; i < 3; ++i) {
    const double share = street.MatchFrom(OnRoad(0.3), Vector6::Zero(), 0.05).new_content_share;
    EXPECT_GT(share, 0.0);
    EXPECT_LT(share, last_share);
    last_share = share;
    for (int k = 0; k < 4; ++k) street.InsertFrom(OnRoad(0.1 * k));
  }
  EXPECT_LT(last_share, 0.2);
}

TEST(NdtMatcher, TheLastScanHoldsAllOfAMatchAgainstAMapOfItself) {
  NdtMatcherIn street(test::Street());
  street.InsertFrom(OnRoad(0.0));
  const MatchResult alone = street.MatchFrom(OnRoad(0.3), Vector6::Zero(), 0.05);
  ASSERT_TRUE(alone.observability.share_of_last_scan);
  const Matrix6 most = NdtParameters::kMaxShareOfLastScan * Matrix6::Identity();
  EXPECT_LT((*alone.observability.share_of_last_scan - most).cwiseAbs().maxCoeff(), 1e-3);
  for (int i = 0; i < 12; ++i) street.InsertFrom(OnRoad(0.02 * i));
  const MatchResult among_more = street.MatchFrom(OnRoad(0.3), Vector6::Zero(), 0.05);
  ASSERT_TRUE(among_more.observability.share_of_last_scan);
  const Vector6 shares = among_more.observability.share_of_last_scan->diagonal();
  EXPECT_GT(shares.minCoeff(), 0.0);
  EXPECT_LT(shares.maxCoeff(), 0.3) << "thirteen scans are in the map";
}

// Two walls beside the road are old, and one across it was seen by the last scan alone: it holds
// the way along the road, and nothing else.
TEST(NdtMatcher, ADirectionIsTheLastScansWhereThatAloneHoldsIt) {
  const std::vector<test::Box> sides = {{{0, 6, 0}, {30, 0.5, 4}}, {{0, -6, 0}, {30, 0.5, 4}}};
  std::vector<test::Box> with_end = sides;
  with_end.push_back({{8, 0, 0}, {0.5, 6, 4}});
  const test::Scene before(-1.2, sides);
  const test::Scene now(-1.2, with_end);
  test::NdtMatcherIn place(now);
  test::NdtMatcherIn old(before);
  const auto at = [](double x_m) { return Pose{Quaternion::Identity(), Vector3(x_m, 0.0, 0.0)}; };
  for (int i = 0; i < 12; ++i) place.Insert(old.See(at(0.02 * i)), at(0.02 * i));
  place.InsertFrom(at(0.3));
  const MatchResult result = place.MatchFrom(at(0.3), Vector6::Zero(), 0.02);
  ASSERT_TRUE(result.observability.share_of_last_scan);
  EXPECT_GT((*result.observability.share_of_last_scan)(0, 0), 0.8);
  EXPECT_LT((*result.observability.share_of_last_scan)(1, 1), 0.3);
  EXPECT_LT((*result.observability.share_of_last_scan)(2, 2), 0.3);
}

// A room whose walls are 1.5 m away fills its cells within a few scans. They hold the errors of
// these few, so the next scans are no independent measurements of the place.
TEST(NdtMatcher, AFewScansOfANarrowPlaceDoNotFreezeTheMap) {
  std::vector<test::Box> walls;
  for (const double side : {-1.0, 1.0}) {
    walls.push_back({{0, 1.6 * side, 0}, {2.0, 0.1, 3}});
    walls.push_back({{2.1 * side, 0, 0}, {0.1, 2.0, 3}});
  }
  NdtMatcherIn room(test::Scene(-1.2, walls));
  for (int i = 0; i < 8; ++i) room.InsertFrom({Quaternion::Identity(), Vector3(0.05 * i, 0, 0)});
  const Pose truth{Quaternion::Identity(), Vector3(0.2, 0, 0)};
  const MatchResult result = room.MatchFrom(truth, Vector6::Zero(), 0.02);
  EXPECT_GT(result.new_content_share, 0.05);
  EXPECT_LT(result.new_content_share, 0.2) << "eight scans are in the map";
}

// The lidar is two metres from the body's origin, which lies behind the wall that the lidar sees.
TEST(NdtMatcher, SurfacesAreSeenFromTheLidarsPlace) {
  const Pose T_map_imu{Quaternion::Identity(), Vector3(1.0, 0.0, 0.0)};
  const Pose T_imu_lidar{Quaternion::Identity(), Vector3(-2.0, 0.0, 0.0)};
  Points wall_imu;
  for (int i = -30; i < 30; ++i) {
    for (int k = -30; k < 30; ++k) {
      wall_imu.emplace_back(-0.9f, 0.1f * static_cast<float>(i), 0.1f * static_cast<float>(k));
    }
  }
  NdtMatcher matcher{NdtOptions{}};
  matcher.Insert({.points_imu = wall_imu, .T_imu_lidar = T_imu_lidar}, T_map_imu);
  MatchInput input{wall_imu, T_map_imu, 1e-4 * Matrix6::Identity()};
  EXPECT_EQ(matcher.Match(input).num_matched, 0) << "from behind";
  input.T_imu_lidar = T_imu_lidar;
  EXPECT_GT(matcher.Match(input).num_matched, static_cast<int>(wall_imu.size() / 2));
}

// A floor on a voxel face is split between two cells by its noise; the turned grid has no such
// face for horizontal floors and vertical walls.
TEST(NdtMatcher, GroundOnAVoxelFaceIsMatchedAsWell) {
  for (const double ground_z_m : {-1.0, -1.5}) {
    std::vector<test::Box> boxes;
    for (const double y : {-6.0, 7.0}) boxes.push_back({{0, y, 0}, {40, 0.5, 5}});
    for (const double x : {-12.0, 9.0}) boxes.push_back({{x, 3, 0}, {0.5, 2, 5}});
    NdtMatcherIn room(test::Scene(ground_z_m, boxes));
    const auto at = [](double x) { return Pose{Quaternion::Identity(), Vector3(x, 0, 0)}; };
    for (double x = 0.0; x <= 3.0; x += 0.5) room.InsertFrom(at(x));
    double worst_m = 0;
    for (int i = 0; i < 5; ++i) {
      const MatchResult result = room.MatchFrom(at(1.7), Vector6::Zero(), 0.05);
      ASSERT_TRUE(result.IsUsable());
      worst_m = std::max(worst_m, std::abs(result.T_map_imu.translation.z()));
    }
    EXPECT_LT(worst_m, 2e-3) << "ground at " << ground_z_m;
  }
}

}  // namespace
}  // namespace lio
