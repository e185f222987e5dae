// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/loam_features.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>

#include "support/ray_scene.hpp"

namespace lio {
namespace {

using test::CastTurn;
using test::Cylinder;
using test::RayBox;
using test::RayCastSweep;
using test::RayScene;
using test::SpinningLidar;

constexpr int kGround = 0;

// The sensor is 1.8 m above the ground of a street with houses on both sides and a few poles.
RayScene Street() {
  RayScene scene;
  scene.AddGround(-1.8);
  scene.Add(RayBox{{8, 9, 2}, {5, 3, 6}, 0.1});
  scene.Add(RayBox{{-6, 10, 2}, {6, 4, 6}, -0.1});
  scene.Add(RayBox{{4, -11, 2}, {7, 4, 6}, 0.05});
  scene.Add(RayBox{{-12, -9, 2}, {4, 3, 6}, 0.3});
  scene.Add(RayBox{{22, 0, 2}, {2, 4, 6}, 0.5});
  scene.Add(Cylinder{{5, 4, -1.8}, 0.15, 6});
  scene.Add(Cylinder{{-3, -5, -1.8}, 0.15, 6});
  return scene;
}

RayCastSweep StreetCast(double start_azimuth_rad = 0.0, double range_std_m = 0.0) {
  SpinningLidar lidar = SpinningLidar::Hdl32e();
  lidar.start_azimuth_rad = start_azimuth_rad;
  lidar.range_std_m = range_std_m;
  return CastTurn(Street(), lidar, Pose::Identity());
}

LoamFeatures Extract(const Sweep& sweep, const LoamFeatureOptions& options = {}) {
  return ExtractLoamFeatures(sweep, options, LidarRig{});
}

Vector3 PositionOf(const LidarPoint& point) {
  return {point.x_m, point.y_m, point.z_m};
}

using Place = std::array<float, 3>;
std::set<Place> PlacesOf(const Sweep& sweep, const std::vector<std::uint32_t>& indices) {
  std::set<Place> places;
  for (const std::uint32_t i : indices) {
    const LidarPoint& p = sweep.points[i];
    places.insert({p.x_m, p.y_m, p.z_m});
  }
  return places;
}

std::array<std::set<Place>, 6> AllPlaces(const Sweep& sweep, const LoamFeatures& features) {
  return {PlacesOf(sweep, features.sharp),    PlacesOf(sweep, features.less_sharp),
          PlacesOf(sweep, features.flat),     PlacesOf(sweep, features.less_flat),
          PlacesOf(sweep, features.occluded), PlacesOf(sweep, features.grazed)};
}

TEST(LoamFeatures, SharpPointsLieWhereTheSurfaceTurnsOrEnds) {
  const RayCastSweep cast = StreetCast();
  const LoamFeatures features = Extract(cast.sweep);
  ASSERT_GT(features.sharp.size(), 100u);
  // A sharp point has, along its ring and within five steps, a neighbour on another object or face.
  std::vector<std::vector<std::uint32_t>> rings(32);
  std::vector<std::size_t> place(cast.hits.size());
  for (std::uint32_t i = 0; i < cast.hits.size(); ++i) {
    auto& ring = rings[cast.sweep.points[i].ring];
    place[i] = ring.size();
    ring.push_back(i);
  }
  for (const std::uint32_t i : features.sharp) {
    const auto& ring = rings[cast.sweep.points[i].ring];
    bool turns = cast.hits[i].normal.z() == 0 && cast.hits[i].object >= 6;  // a pole turns all over
    for (std::size_t k = place[i] - 5; k <= place[i] + 5; ++k) {
      const test::Hit& other = cast.hits[ring[k]];
      turns |=
          other.object != cast.hits[i].object || (other.normal - cast.hits[i].normal).norm() > 1e-6;
    }
    EXPECT_TRUE(turns) << "at " << PositionOf(cast.sweep.points[i]).transpose();
  }
}

TEST(LoamFeatures, VerticalCornersOfHousesArePicked) {
  const RayCastSweep cast = StreetCast();
  const LoamFeatures features = Extract(cast.sweep);
  // Finds the corner of the first house that faces the sensor.
  const Vector3 corner = Vector3(8, 9, 0) + ExpSo3(Vector3(0, 0, 0.1)) * Vector3(-5, -3, 0);
  int num_near = 0;
  for (const std::uint32_t i : features.less_sharp) {
    const Vector3 p = PositionOf(cast.sweep.points[i]);
    num_near += (p - corner).head<2>().norm() < 0.06 && cast.hits[i].object == 1;
  }
  EXPECT_GE(num_near, 8);  // rings meet it
}

TEST(LoamFeatures, FlatPointsLieOnPlanes) {
  const RayCastSweep cast = StreetCast();
  const LoamFeatures features = Extract(cast.sweep);
  ASSERT_GT(features.flat.size(), 400u);
  int num_on_poles = 0;
  for (const std::uint32_t i : features.flat) num_on_poles += cast.hits[i].object >= 6;
  EXPECT_LE(num_on_poles, static_cast<int>(features.flat.size()) / 100);
}

TEST(LoamFeatures, SectorsGiveNoMoreThanTheirShare) {
  // Thirty poles around give far more edges on each ring than may be picked.
  RayScene scene;
  scene.AddGround(-1.8);
  for (int i = 0; i < 90; ++i) {
    const double azimuth = 2 * std::numbers::pi * i / 90;
    scene.Add(Cylinder{{8 * std::cos(azimuth), 8 * std::sin(azimuth), -1.8}, 0.12, 5});
    scene.Add(
        Cylinder{{12 * std::cos(azimuth + 0.03), 12 * std::sin(azimuth + 0.03), -1.8}, 0.15, 5});
  }
  const RayCastSweep cast = CastTurn(scene, SpinningLidar::Hdl32e(), Pose::Identity());
  LoamFeatureOptions options;
  const LoamFeatures features = Extract(cast.sweep, options);
  std::array<int, 32> sharp{};
  std::array<int, 32> less_sharp{};
  std::array<int, 32> flat{};
  for (const std::uint32_t i : features.sharp) ++sharp[cast.sweep.points[i].ring];
  for (const std::uint32_t i : features.less_sharp) ++less_sharp[cast.sweep.points[i].ring];
  for (const std::uint32_t i : features.flat) ++flat[cast.sweep.points[i].ring];
  EXPECT_EQ(*std::max_element(sharp.begin(), sharp.end()), 6 * options.num_sharp);
  EXPECT_LE(*std::max_element(less_sharp.begin(), less_sharp.end()), 6 * options.num_less_sharp);
  EXPECT_GT(*std::max_element(less_sharp.begin(), less_sharp.end()), 60);
  EXPECT_EQ(*std::max_element(flat.begin(), flat.end()), 6 * options.num_flat);
}

TEST(LoamFeatures, NeighboursOfAPickAreNotPickedUnlessTheSurfaceBreaks) {
  const RayCastSweep cast = StreetCast(0.0, 0.02);
  LoamFeatureOptions options;
  const LoamFeatures features = Extract(cast.sweep, options);
  std::vector<std::vector<std::uint32_t>> rings(32);
  for (std::uint32_t i = 0; i < cast.hits.size(); ++i) {
    rings[cast.sweep.points[i].ring].push_back(i);
  }
  std::vector<bool> is_picked(cast.hits.size());
  for (const std::uint32_t i : features.less_sharp) is_picked[i] = true;
  for (const std::uint32_t i : features.flat) is_picked[i] = true;
  int num_pairs_across_breaks = 0;
  for (const auto& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (!is_picked[ring[i]]) continue;
      bool is_connected = true;
      for (std::size_t k = i + 1; k < std::min(i + 6, ring.size()); ++k) {
        const Vector3 step =
            PositionOf(cast.sweep.points[ring[k]]) - PositionOf(cast.sweep.points[ring[k - 1]]);
        is_connected &= step.squaredNorm() <= options.break_m2;
        if (!is_picked[ring[k]]) continue;
        EXPECT_FALSE(is_connected);
        ++num_pairs_across_breaks;
      }
    }
  }
  EXPECT_GT(num_pairs_across_breaks, 0);  // the break frees the neighbours
}

// A board is 6 m away, in front of a wall at 15 m.
RayScene BoardBeforeWall() {
  RayScene scene;
  scene.Add(RayBox{{6.05, 0, 0}, {0.05, 1, 4}, 0});
  scene.Add(RayBox{{15.5, 0, 0}, {0.5, 30, 8}, 0});
  return scene;
}

TEST(LoamFeatures, BorderOfAShadowIsLeftOut) {
  SpinningLidar lidar = SpinningLidar::Hdl32e();
  lidar.start_azimuth_rad = std::numbers::pi;  // the seam is behind
  const RayCastSweep cast = CastTurn(BoardBeforeWall(), lidar, Pose::Identity());
  const LoamFeatures features = Extract(cast.sweep);
  // The board's sides cast their shadow on the wall at |y| = 15/6.
  const auto is_at_shadow = [&](std::uint32_t i) {
    const Vector3 p = PositionOf(cast.sweep.points[i]);
    return cast.hits[i].object == 1 && std::abs(std::abs(p.y()) - 2.5) < 0.25 &&
           std::abs(p.z()) < 4 * 15 / 6.1;
  };
  int num_occluded = 0;
  for (const std::uint32_t i : features.occluded) num_occluded += is_at_shadow(i);
  EXPECT_GE(num_occluded, 2 * 20 * 4);  // both sides, most rings
  for (const auto* set : {&features.less_sharp, &features.flat, &features.less_flat}) {
    EXPECT_EQ(std::count_if(set->begin(), set->end(), is_at_shadow), 0);
  }
  // The board's own sides are real edges.
  int num_board_edges = 0;
  for (const std::uint32_t i : features.less_sharp) {
    num_board_edges +=
        cast.hits[i].object == 0 && std::abs(std::abs(cast.sweep.points[i].y_m) - 1) < 0.05;
  }
  EXPECT_GE(num_board_edges, 40);
}

TEST(LoamFeatures, SurfacesNearlyParallelToTheBeamAreLeftOut) {
  // A long wall passes 1 m beside the sensor: beyond 8 m the beams are at grazing incidence, below
  // 7 deg.
  RayScene scene;
  scene.Add(RayBox{{20, 1.5, 0}, {19, 0.5, 6}, 0});
  SpinningLidar lidar = SpinningLidar::Hdl32e();
  lidar.start_azimuth_rad = std::numbers::pi;
  lidar.range_std_m = 0.02;
  const RayCastSweep cast = CastTurn(scene, lidar, Pose::Identity());
  const LoamFeatures features = Extract(cast.sweep);
  // The very end is left out, because the wall's end truncates the window.
  const auto is_grazed = [&](std::uint32_t i) {
    const double x = cast.sweep.points[i].x_m;
    return x > 8 && x < 25;
  };
  int num_grazed = 0;
  for (const std::uint32_t i : features.grazed) num_grazed += is_grazed(i);
  EXPECT_GT(num_grazed, 300);
  int num_kept = 0;
  for (const auto* set : {&features.less_sharp, &features.flat, &features.less_flat}) {
    num_kept += static_cast<int>(std::count_if(set->begin(), set->end(), is_grazed));
  }
  EXPECT_LE(num_kept, num_grazed / 50);  // noise, now and then
  // Points that the beams meet at 20 deg and more stay.
  int num_steep = 0;
  for (const std::uint32_t i : features.less_flat) num_steep += cast.sweep.points[i].x_m < 2.5;
  EXPECT_GT(num_steep, 100);
}

TEST(LoamFeatures, NoisyWallFacingTheSensorIsNotGrazed) {
  RayScene scene;
  scene.Add(RayBox{{3, 0, 0}, {1, 30, 8}, 0});
  SpinningLidar lidar = SpinningLidar::Hdl32e();
  lidar.range_std_m = 0.02;
  const RayCastSweep cast = CastTurn(scene, lidar, Pose::Identity());
  const LoamFeatures features = Extract(cast.sweep);
  EXPECT_GT(features.less_flat.size(), 100u);
  for (const std::uint32_t i : features.grazed) {
    EXPECT_GT(std::abs(cast.sweep.points[i].y_m), 5.f);
  }
}

TEST(LoamFeatures, RingsAreRebuiltFromElevation) {
  const RayCastSweep cast = StreetCast();
  Sweep without = cast.sweep;
  for (LidarPoint& point : without.points) point.ring = 0;
  const LoamFeatures expected = Extract(cast.sweep);
  const LoamFeatures rebuilt =
      ExtractLoamFeatures(without, {}, LidarRig{}, SpinningLidar::Hdl32e().elevation_rad);
  EXPECT_EQ(rebuilt.sharp, expected.sharp);
  EXPECT_EQ(rebuilt.less_sharp, expected.less_sharp);
  EXPECT_EQ(rebuilt.flat, expected.flat);
  EXPECT_EQ(rebuilt.less_flat, expected.less_flat);
  ASSERT_EQ(rebuilt.rebuilt_rings.size(), cast.sweep.points.size());
  for (std::size_t i = 0; i < cast.sweep.points.size(); ++i) {
    ASSERT_EQ(rebuilt.rebuilt_rings[i], cast.sweep.points[i].ring);
  }
}

TEST(LoamFeatures, WithoutRingsAndBeamsThereAreNone) {
  Sweep sweep = StreetCast().sweep;
  for (LidarPoint& point : sweep.points) point.ring = 0;
  const LoamFeatures features = Extract(sweep);
  EXPECT_TRUE(features.less_sharp.empty());
  EXPECT_TRUE(features.less_flat.empty());
}

TEST(LoamFeatures, OrderOfThePointsDoesNotMatter) {
  const Sweep sweep = StreetCast(0.0, 0.02).sweep;
  Sweep shuffled = sweep;
  std::shuffle(shuffled.points.begin(), shuffled.points.end(), std::mt19937(7));
  EXPECT_EQ(AllPlaces(shuffled, Extract(shuffled)), AllPlaces(sweep, Extract(sweep)));
}

TEST(LoamFeatures, TurnsMayBeginAtAnyAzimuth) {
  // The same corner of a house is found with the seam behind, and just beside the wrap of atan2.
  for (const double start : {std::numbers::pi, 3.1, -3.1, 0.5}) {
    const RayCastSweep cast = StreetCast(start);
    const LoamFeatures features = Extract(cast.sweep);
    const Vector3 corner = Vector3(8, 9, 0) + ExpSo3(Vector3(0, 0, 0.1)) * Vector3(-5, -3, 0);
    int num_near = 0;
    for (const std::uint32_t i : features.less_sharp) {
      num_near += (PositionOf(cast.sweep.points[i]) - corner).head<2>().norm() < 0.06;
    }
    EXPECT_GE(num_near, 8) << "turn starting at " << start;
  }
}

TEST(LoamFeatures, WithoutTimesRingsAreOrderedByAzimuth) {
  const Sweep timed = StreetCast(0.5).sweep;
  Sweep untimed = timed;  // ring after ring, as KITTI stores them
  for (LidarPoint& point : untimed.points) point.t_offset_ns = 0;
  std::stable_sort(untimed.points.begin(), untimed.points.end(),
                   [](const auto& a, const auto& b) { return a.ring > b.ring; });
  EXPECT_EQ(AllPlaces(untimed, Extract(untimed)), AllPlaces(timed, Extract(timed)));
}

TEST(LoamFeatures, LessFlatHasOnePointAVoxelAndRing) {
  const RayCastSweep cast = StreetCast();
  LoamFeatureOptions options;
  const LoamFeatures features = Extract(cast.sweep, options);
  std::set<std::array<int, 4>> voxels;
  for (const std::uint32_t i : features.less_flat) {
    const LidarPoint& p = cast.sweep.points[i];
    const auto floor = [&](float v) {
      return static_cast<int>(std::floor(v * static_cast<float>(1 / options.leaf_m)));
    };
    EXPECT_TRUE(voxels.insert({p.ring, floor(p.x_m), floor(p.y_m), floor(p.z_m)}).second);
  }
  EXPECT_GT(voxels.size(), 5000u);
}

TEST(LoamFeatures, UnusablePointsArePassedOver) {
  RayCastSweep cast = StreetCast();
  const LoamFeatures expected = Extract(cast.sweep);
  const auto expected_places = AllPlaces(cast.sweep, expected);
  for (int i = 0; i < 500; ++i) {
    LidarPoint bad = cast.sweep.points[static_cast<std::size_t>(i) * 37];
    if (i % 2 == 0) {
      bad.x_m = std::numeric_limits<float>::quiet_NaN();
    } else {
      bad.x_m = bad.y_m = bad.z_m = 0.1f;  // nearer than the rig's min_range_m
    }
    cast.sweep.points.push_back(bad);
  }
  EXPECT_EQ(AllPlaces(cast.sweep, Extract(cast.sweep)), expected_places);
}

TEST(LoamFeatures, EmptyAndTinySweepsHaveNone) {
  EXPECT_TRUE(Extract(Sweep{}).less_flat.empty());
  Sweep sweep = StreetCast().sweep;
  sweep.points.resize(40);
  EXPECT_TRUE(Extract(sweep).less_sharp.empty());
}

}  // namespace
}  // namespace lio
