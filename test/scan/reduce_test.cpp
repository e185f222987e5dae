// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/reduce.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <tuple>

#include "support/motion.hpp"
#include "support/scene.hpp"

namespace lio {
namespace {

LidarPoint PointAt(float x, float y, float z, std::uint32_t t_offset_ns = 0) {
  LidarPoint point;
  point.x_m = x;
  point.y_m = y;
  point.z_m = z;
  point.t_offset_ns = t_offset_ns;
  return point;
}

Sweep SweepOf(std::vector<LidarPoint> points) {
  Sweep sweep;
  sweep.points = std::move(points);
  return sweep;
}

// Under these options the edge keeps its place.
ReduceOptions FixedEdge(double edge_m) {
  ReduceOptions options;
  options.voxel_m = options.min_voxel_m = options.max_voxel_m = edge_m;
  return options;
}

LidarRig AnyRange() {
  LidarRig rig;
  rig.min_range_m = 0.0;
  rig.max_range_m = 1000.0;
  return rig;
}

// Returns one turn of the lidar in the street.
Sweep DrivenStreet() {
  static const std::vector<LidarPoint> kPoints = [] {
    std::mt19937_64 random(5);
    return test::CastSweep(test::Street(), test::TestLidar(), test::WindingDrive(0.0), 5.0, random);
  }();
  return SweepOf(kPoints);
}

bool IsSame(const ReducedScan& a, const ReducedScan& b) {
  return a.voxel_m == b.voxel_m &&
         std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(),
                    [](const ScanPoint& p, const ScanPoint& q) {
                      return p.position == q.position && p.t_offset_ns == q.t_offset_ns;
                    });
}

TEST(Reduce, KeepsThePointNearestTheVoxelsCentre) {
  ScanReducer reducer(FixedEdge(1.0), AnyRange());
  const ReducedScan scan =
      reducer.Reduce(SweepOf({PointAt(5.1f, 0.2f, 0.3f), PointAt(5.4f, 0.6f, 0.5f),
                              PointAt(5.9f, 0.5f, 0.5f), PointAt(-5.5f, 0.5f, 0.5f)}));
  ASSERT_EQ(scan.points.size(), 2u);
  std::set<float> xs = {scan.points[0].position.x(), scan.points[1].position.x()};
  EXPECT_EQ(xs, (std::set<float>{-5.5f, 5.4f}));
}

TEST(Reduce, OnePointAVoxelIsLeft) {
  ScanReducer reducer(FixedEdge(0.7), AnyRange());
  std::set<std::tuple<int, int, int>> voxels;
  const ReducedScan scan = reducer.Reduce(DrivenStreet());
  for (const ScanPoint& point : scan.points) {
    const auto floor = [&](float x) { return static_cast<int>(std::floor(x * (1.0f / 0.7f))); };
    voxels.insert(
        {floor(point.position.x()), floor(point.position.y()), floor(point.position.z())});
  }
  EXPECT_EQ(voxels.size(), scan.points.size());
  EXPECT_LT(scan.points.size(), DrivenStreet().points.size());
}

// Order within the sweep must not matter, also where distances tie.
TEST(Reduce, OrderOfThePointsDoesNotMatter) {
  Sweep sweep = DrivenStreet();
  for (int i = 0; i < 200; ++i) {  // mirror images in the same voxel, at other times
    const float x = 20.0f + static_cast<float>(i);
    sweep.points.push_back(PointAt(x + 0.25f, 0.25f, 0.25f, 7000));
    sweep.points.push_back(PointAt(x + 0.75f, 0.25f, 0.25f, 6000));
    sweep.points.push_back(PointAt(x + 0.25f, 0.75f, 0.25f, 6000));
  }
  ScanReducer reference(FixedEdge(1.0), AnyRange());
  const ReducedScan expected = reference.Reduce(sweep);
  std::mt19937 random(1);
  for (int i = 0; i < 5; ++i) {
    std::shuffle(sweep.points.begin(), sweep.points.end(), random);
    ScanReducer reducer(FixedEdge(1.0), AnyRange());
    EXPECT_TRUE(IsSame(reducer.Reduce(sweep), expected)) << "shuffle " << i;
  }
}

TEST(Reduce, PointsLeaveInOrderOfTime) {
  Sweep sweep = DrivenStreet();
  std::shuffle(sweep.points.begin(), sweep.points.end(), std::mt19937(2));
  ScanReducer reducer(FixedEdge(0.5), AnyRange());
  const ReducedScan scan = reducer.Reduce(sweep);
  EXPECT_TRUE(std::is_sorted(
      scan.points.begin(), scan.points.end(),
      [](const ScanPoint& a, const ScanPoint& b) { return a.t_offset_ns < b.t_offset_ns; }));
}

TEST(Reduce, NonFinitePointsAreDroppedAndCounted) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  ScanReducer reducer(FixedEdge(1.0), AnyRange());
  const ReducedScan scan =
      reducer.Reduce(SweepOf({PointAt(nan, 5, 0), PointAt(5, nan, 0), PointAt(5, 5, nan),
                              PointAt(inf, -inf, 0), PointAt(0, 0, inf), PointAt(5, 5, 5)}));
  EXPECT_EQ(scan.num_nonfinite, 5);
  ASSERT_EQ(scan.points.size(), 1u);
  EXPECT_EQ(scan.points[0].position, Eigen::Vector3f(5, 5, 5));
}

TEST(Reduce, NearFarAndOwnVehicleAreDropped) {
  LidarRig rig;
  rig.min_range_m = 2.0;
  rig.max_range_m = 50.0;
  rig.own_vehicle_box = OwnVehicleBox{Vector3(-4, -1, -2), Vector3(1, 1, 0)};
  ScanReducer reducer(FixedEdge(0.5), rig);
  const ReducedScan scan =
      reducer.Reduce(SweepOf({PointAt(1.9f, 0, 0), PointAt(0, 51, 0), PointAt(-3, 0.5f, -1),
                              PointAt(-3, 1.5f, -1), PointAt(1e30f, 1e30f, 0), PointAt(49, 0, 0)}));
  std::set<float> xs;
  for (const ScanPoint& point : scan.points) xs.insert(point.position.x());
  EXPECT_EQ(xs, (std::set<float>{-3.0f, 49.0f}));
  EXPECT_EQ(scan.num_nonfinite, 0);
}

TEST(Reduce, EdgeAdaptsToTheWantedNumber) {
  ReduceOptions options;
  options.target_points = 1500;
  options.voxel_m = 0.3;
  options.max_voxel_m = 5.0;
  ScanReducer reducer(options, AnyRange());
  ReducedScan scan;
  for (int i = 0; i < 20; ++i) scan = reducer.Reduce(DrivenStreet());
  EXPECT_NEAR(static_cast<double>(scan.points.size()), 1500.0, 75.0);
}

TEST(Reduce, EdgeStaysWithinItsLimits) {
  ReduceOptions options;
  options.voxel_m = 0.5;
  options.min_voxel_m = 0.4;
  options.max_voxel_m = 0.8;
  for (const int target : {100, 1000000}) {
    options.target_points = target;
    ScanReducer reducer(options, AnyRange());
    ReducedScan scan;
    for (int i = 0; i < 10; ++i) scan = reducer.Reduce(DrivenStreet());
    EXPECT_FLOAT_EQ(scan.voxel_m, target == 100 ? 0.8f : 0.4f);
  }
}

TEST(Reduce, EmptySweepGivesNoPointsAndKeepsTheEdge) {
  ReduceOptions options;
  options.target_points = 1000;
  ScanReducer reducer(options, AnyRange());
  const float edge_m = reducer.Reduce(Sweep{}).voxel_m;
  EXPECT_EQ(reducer.Reduce(Sweep{}).voxel_m, edge_m);
  EXPECT_TRUE(reducer.Reduce(Sweep{}).points.empty());
}

// There are more voxels than the table begins with: it grows, and gives the result of a fresh one.
TEST(Reduce, AnyNumberOfVoxelsFits) {
  std::vector<LidarPoint> points;
  for (int x = 0; x < 170; ++x) {
    for (int y = 0; y < 170; ++y) {
      points.push_back(PointAt(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, 0.5f,
                               static_cast<std::uint32_t>(x * 170 + y)));
    }
  }
  ScanReducer reducer(FixedEdge(1.0), AnyRange());
  const ReducedScan scan = reducer.Reduce(SweepOf(points));
  EXPECT_EQ(scan.points.size(), 28900u);
  EXPECT_TRUE(IsSame(reducer.Reduce(SweepOf(points)), scan));
}

// Sweeps far larger than needed are sampled down first, by time and beam alone.
TEST(Reduce, HugeSweepsAreSampledWhateverTheirOrder) {
  std::vector<LidarPoint> points;
  for (std::uint32_t i = 0; i < 90000; ++i) {
    points.push_back(PointAt(static_cast<float>(i % 300) + 0.5f, static_cast<float>(i / 300) + 0.5f,
                             0.5f, 1000 * i));
  }
  const ReducedScan scan = ScanReducer(FixedEdge(1.0), AnyRange()).Reduce(SweepOf(points));
  EXPECT_GT(scan.points.size(), 28000u);
  EXPECT_LT(scan.points.size(), 36000u);
  std::reverse(points.begin(), points.end());
  EXPECT_TRUE(IsSame(ScanReducer(FixedEdge(1.0), AnyRange()).Reduce(SweepOf(points)), scan));
}

}  // namespace
}  // namespace lio
