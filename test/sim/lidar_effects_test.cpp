// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Each effect of the field on a lidar is measured by switching it on alone. Errors that are drawn
// once a laser are measured over many lidars: bounds are three standard errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "lio/sim/scenario.hpp"
#include "sim/closed_room.hpp"
#include "sim/field_sweep.hpp"

namespace lio::sim {
namespace {

using test::Only;
using test::OptionsOf;
using test::Room;
using test::RoomError;
using test::SweepIn;

// Averages a value over each ring's points, and returns the root mean square over the rings.
class RmsOfRings {
 public:
  void Add(std::uint16_t ring, double value) {
    sums_[ring].first += value;
    sums_[ring].second += 1;
  }
  void EndSweep() {
    for (const auto& [ring, sum] : sums_) {
      const double mean = sum.first / sum.second;
      sum_sq_ += mean * mean;
      ++num_;
    }
    sums_.clear();
  }
  int num() const { return num_; }
  double rms() const { return std::sqrt(sum_sq_ / num_); }
  // Three standard errors of the root mean square of `num` normal draws, relative to it.
  double bound_ratio() const { return 3.0 / std::sqrt(2.0 * num_); }

 private:
  std::map<std::uint16_t, std::pair<double, int>> sums_;
  double sum_sq_ = 0.0;
  int num_ = 0;
};

TEST(LidarEffects, EachLaserHasItsOwnBiasOfEightMillimetres) {
  RmsOfRings biases;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    std::map<std::uint16_t, std::pair<double, double>> range_of;
    for (const LidarPoint& point : SweepIn(Room(), Only("laser-bias"), seed).points) {
      const double error = RoomError(point);
      const auto [at, is_new] = range_of.try_emplace(point.ring, error, error);
      at->second = {std::min(at->second.first, error), std::max(at->second.second, error)};
      biases.Add(point.ring, error);
    }
    ASSERT_EQ(range_of.size(), 32u);
    for (const auto& [ring, range] : range_of) EXPECT_LT(range.second - range.first, 2e-4) << ring;
    biases.EndSweep();
  }
  EXPECT_NEAR(biases.rms(), 0.008, biases.bound_ratio() * 0.008);
}

TEST(LidarEffects, RangesGrowAtGrazingIncidence) {
  const std::vector<LidarPoint> points = SweepIn(Room(), Only("grazing-bias")).points;
  double largest = 0.0;
  for (const LidarPoint& point : points) {
    const Vector3 p(point.x_m, point.y_m, point.z_m);
    const double error = RoomError(point);
    const bool is_floor = std::abs(p.x()) < 18.0 && std::abs(p.y()) < 13.0 && p.z() < -1.9;
    if (is_floor) {
      const double cos_incidence = -p.z() / p.norm();
      EXPECT_NEAR(error, std::min(0.006 * (1.0 / cos_incidence - 1.0), 0.04), 2e-4);
    }
    largest = std::max(largest, error);
  }
  EXPECT_NEAR(largest, 0.04, 2e-4);
}

// Tells whether it lies on the wall ahead, which is 20 m away, well off its edges.
bool IsOnWallAhead(const LidarPoint& point) {
  return point.x_m > 19.0f && std::abs(point.y_m) < 14.0f && std::abs(point.z_m + 0.5f) < 1.0f;
}

// Points of a wall are nearer by 4 mm with each doubling of their echo beyond 0.3, those of
// retroreflectors by 5 cm, which is seen here in whole sweeps: the wall's material and slant make
// the echo.
TEST(LidarEffects, StrongEchoesAndRetroreflectorsAreNearer) {
  const RecordOptions options = Only("intensity-bias");
  const std::map<Material, double> reflectivities = {
      {Material::kAsphalt, 0.17}, {Material::kBrick, 0.38}, {Material::kPlaster, 0.6}};
  for (const auto& [material, reflectivity] : reflectivities) {
    int num = 0;
    for (const LidarPoint& point : SweepIn(Room(material), options).points) {
      if (!IsOnWallAhead(point)) continue;
      const double range = std::hypot(point.x_m, point.y_m, point.z_m);
      const double echo = reflectivity * std::sqrt(point.x_m / range);
      EXPECT_NEAR(RoomError(point), -0.004 * std::log2(echo / 0.3), 1e-4);
      ++num;
    }
    EXPECT_GT(num, 200) << reflectivity;
  }
  for (const LidarPoint& point : SweepIn(Room(Material::kRetro), options).points) {
    if (IsOnWallAhead(point)) {
      EXPECT_NEAR(RoomError(point), -0.05, 1e-4);
    }
  }
}

// A turned beam meets floor and walls elsewhere, and its point is drawn where the table says. So
// the floor shows the error of its elevation, and a wall that it meets aslant that of its azimuth.
TEST(LidarEffects, TheBeamTableIsOffByAFiftiethOfADegreeEitherWay) {
  RmsOfRings elevation_rad, azimuth_rad;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    for (const LidarPoint& point : SweepIn(Room(), Only("beam-table"), seed).points) {
      const double range = std::hypot(point.x_m, point.y_m, point.z_m);
      const double across = std::hypot(point.x_m, point.y_m);
      if (point.z_m < -1.0f && across < 12.0) {
        elevation_rad.Add(point.ring, std::asin(2.0 / range) - std::asin(-point.z_m / range));
      }
      const double azimuth = std::atan2(point.y_m, point.x_m);
      const bool is_aslant = std::abs(azimuth) > 0.4 && std::abs(azimuth) < 0.6;
      if (std::abs(point.z_m) < 0.06 * across && is_aslant) {
        const double seen = std::copysign(std::acos(std::min(1.0, 20.0 / across)), azimuth);
        azimuth_rad.Add(point.ring, seen - azimuth);
      }
    }
    elevation_rad.EndSweep();
    azimuth_rad.EndSweep();
  }
  constexpr double kFiftiethOfADegree = 0.02 * M_PI / 180.0;
  for (const RmsOfRings* error : {&elevation_rad, &azimuth_rad}) {
    EXPECT_GT(error->num(), 150);
    EXPECT_NEAR(error->rms(), kFiftiethOfADegree, error->bound_ratio() * kFiftiethOfADegree);
  }
}

// A pane 10 m ahead has a wall 3 m behind it. Seen through the pane the wall is where it is.
TEST(LidarEffects, AWallBehindAPaneIsSeenThroughItAtItsPlace) {
  World world;
  AddQuad(world.fixed.page(), {10, -5, -5}, {10, 5, -5}, {10, 5, 5}, {10, -5, 5}, Material::kGlass);
  AddQuad(world.fixed.page(), {13, -30, -30}, {13, 30, -30}, {13, 30, 30}, {13, -30, 30},
          Material::kPlaster);
  const SimulatedSweep sweep = SweepIn(world, Only("glass"));
  int num = 0;
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    if (sweep.kinds[i] != EchoKind::kThroughGlass) continue;
    ++num;
    EXPECT_NEAR(sweep.points[i].x_m, 13.0, 1e-3);
  }
  EXPECT_GT(num, 1000);
}

// A facade of glass to the left, and a wall across the way: beams that graze the glass see the
// wall's image behind it, where the wall would be if it went on there.
TEST(LidarEffects, AGrazedPaneShowsTheImageOfAWallBehindIt) {
  World world;
  AddQuad(world.fixed.page(), {0, 3, -5}, {20, 3, -5}, {20, 3, 5}, {0, 3, 5}, Material::kGlass);
  AddQuad(world.fixed.page(), {20, -30, -30}, {20, 2.9, -30}, {20, 2.9, 30}, {20, -30, 30},
          Material::kPlaster);
  const SimulatedSweep sweep = SweepIn(world, Only("glass"));
  int num = 0;
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    if (sweep.kinds[i] != EchoKind::kMirrored) continue;
    ++num;
    EXPECT_NEAR(sweep.points[i].x_m, 20.0, 2e-3);
    EXPECT_GT(sweep.points[i].y_m, 3.0);
  }
  EXPECT_GT(num, 300);
}

struct Shares {
  double in_between = 0.0;
  double in_between_level = 0.0;  // the same of beams within 15 deg of the horizon alone
  double mirrored = 0.0;
  double through_glass = 0.0;
};

// Takes two sweeps of each of three streets.
Shares SharesInStreets(const std::string& lidar_name) {
  const RecordOptions options = OptionsOf(Realism::kField, {}, lidar_name);
  std::map<EchoKind, int> num_of;
  int num = 0, num_level = 0, num_level_between = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Scenario street = MakeScenario("street", {seed, 10.0, true});
    const Scene scene(street.world);
    const LidarSimulator lidar(
        {options.lidar, street.T_imu_lidar, options.lidar_errors, seed, street.begin_s}, scene,
        *street.trajectory);
    for (std::int64_t index = 0; index < 90; index += 45) {
      const SimulatedSweep sweep = lidar.Sweep(index);
      for (std::size_t i = 0; i < sweep.points.size(); ++i) {
        const double elevation = options.lidar.beams[sweep.points[i].ring].elevation_rad;
        const bool is_level = std::abs(elevation) < 15.5 * M_PI / 180.0;
        ++num_of[sweep.kinds[i]];
        ++num;
        num_level += is_level ? 1 : 0;
        num_level_between += is_level && sweep.kinds[i] == EchoKind::kInBetween ? 1 : 0;
      }
    }
  }
  const auto share = [&](EchoKind kind) { return num_of[kind] / static_cast<double>(num); };
  return {share(EchoKind::kInBetween), num_level_between / static_cast<double>(num_level),
          share(EchoKind::kMirrored), share(EchoKind::kThroughGlass)};
}

struct StreetOf {
  const char* lidar;
  Shares expected;
};

class StreetShares : public ::testing::TestWithParam<StreetOf> {};

TEST_P(StreetShares, AreAsTheDocsSay) {
  const Shares shares = SharesInStreets(GetParam().lidar);
  std::printf("| %s | %.1f | %.1f | %.2f | %.2f |\n", GetParam().lidar, 100 * shares.in_between,
              100 * shares.in_between_level, 100 * shares.mirrored, 100 * shares.through_glass);
  const Shares& expected = GetParam().expected;
  EXPECT_NEAR(shares.in_between, expected.in_between, 0.1 * expected.in_between);
  EXPECT_NEAR(shares.in_between_level, expected.in_between_level, 0.1 * expected.in_between_level);
  EXPECT_NEAR(shares.mirrored, expected.mirrored, 0.2 * expected.mirrored);
  EXPECT_NEAR(shares.through_glass, expected.through_glass, 0.2 * expected.through_glass);
}

INSTANTIATE_TEST_SUITE_P(All, StreetShares,
                         ::testing::Values(StreetOf{"hdl32e", {0.022, 0.034, 0.0009, 0.0066}},
                                           StreetOf{"vlp16", {0.038, 0.038, 0.0013, 0.0104}},
                                           StreetOf{"os1_64", {0.040, 0.041, 0.0010, 0.0104}}),
                         [](const auto& test) { return std::string(test.param.lidar); });

}  // namespace
}  // namespace lio::sim
