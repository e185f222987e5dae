// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Judges the estimator's search for mixed pixels by the simulator's own labels, at realism `field`.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>

#include "lio/scan/mixed_pixels.hpp"
#include "lio/scan/point_filter.hpp"
#include "lio/sim/realism.hpp"
#include "lio/sim/scenario.hpp"

namespace lio::sim {
namespace {

struct Tally {
  int num = 0;
  int num_found = 0;

  double share_found() const { return num > 0 ? static_cast<double>(num_found) / num : 0.0; }
};

constexpr std::array<float, 4> kOff_m = {0.05f, 0.2f, 0.5f, 1.0f};  // bins begin here

struct Tallies {
  std::array<Tally, 4> of_kind;  // without dust
  std::array<Tally, kOff_m.size()> mixed_by_off;

  const Tally& Of(EchoKind kind) const { return of_kind.at(static_cast<std::size_t>(kind)); }
};

void Count(bool is_found, Tally& tally) {
  tally.num += 1;
  tally.num_found += is_found ? 1 : 0;
}

std::size_t BinOf(float off_m) {
  std::size_t bin = kOff_m.size() - 1;
  while (bin > 0 && off_m < kOff_m.at(bin)) --bin;
  return bin;
}

Tallies TallyOf(const std::string& place, const std::string& model) {
  const Scenario scenario = MakeScenario(place, {1, 20.0, true});
  RecordOptions options;
  options.lidar = LoadLidarModel(model);
  options.imu = LoadImuModel("ideal");
  SetRealism(Realism::kField, {}, options);
  const Scene scene(scenario.world);
  const LidarSimulator lidar(
      {options.lidar, scenario.T_imu_lidar, options.lidar_errors, 1, scenario.begin_s}, scene,
      *scenario.trajectory);
  LidarRig rig;
  rig.own_vehicle_box = scenario.own_vehicle_box;
  rig.min_range_m = scenario.min_range_m;
  rig.max_range_m = options.lidar.max_range_m;
  const PointFilter filter(rig);
  MixedPixelFinder finder;
  Tallies tallies;
  for (std::int64_t index = 0; index < 200; index += 40) {
    SimulatedSweep simulated = lidar.Sweep(index);
    Sweep sweep;
    sweep.points = std::move(simulated.points);
    finder.Load(sweep);
    for (std::uint32_t i = 0; i < sweep.points.size(); ++i) {
      if (!filter.IsWanted(sweep.points[i])) continue;
      const bool is_found = finder.IsMixed(i);
      const EchoKind kind = simulated.kinds[i];
      Count(is_found, tallies.of_kind.at(static_cast<std::size_t>(kind)));
      if (kind != EchoKind::kInBetween) continue;
      Count(is_found, tallies.mixed_by_off.at(BinOf(simulated.off_surface_m[i])));
    }
  }
  return tallies;
}

// Prints the rows of docs/experiments/mixed_pixels.md.
void Print(const std::string& name, const Tallies& tallies) {
  int num = 0;
  for (const Tally& tally : tallies.of_kind) num += tally.num;
  const auto share = [&](EchoKind kind) { return 100.0 * tallies.Of(kind).num / num; };
  const auto found = [&](EchoKind kind) { return 100.0 * tallies.Of(kind).share_found(); };
  std::printf("| %s | %.1f | %.0f | %.2f | %.2f, %.0f | %.2f, %.0f |\n", name.c_str(),
              share(EchoKind::kInBetween), found(EchoKind::kInBetween), found(EchoKind::kSurface),
              share(EchoKind::kMirrored), found(EchoKind::kMirrored),
              share(EchoKind::kThroughGlass), found(EchoKind::kThroughGlass));
  std::printf("| %s, off |", name.c_str());
  for (const Tally& tally : tallies.mixed_by_off) {
    std::printf(" %.2f, %.0f |", 100.0 * tally.num / num, 100.0 * tally.share_found());
  }
  std::printf("\n");
}

struct PlaceAndLidar {
  const char* place;
  const char* lidar;
  double least_found;  // share of the mixed pixels
  double most_lost;    // share of the good points
};

class MixedPixelShare : public ::testing::TestWithParam<PlaceAndLidar> {};

TEST_P(MixedPixelShare, FoundAndGoodPointsLostAreAsTheDocsSay) {
  const Tallies tallies = TallyOf(GetParam().place, GetParam().lidar);
  Print(std::string(GetParam().place) + ", " + GetParam().lidar, tallies);
  EXPECT_GT(tallies.Of(EchoKind::kInBetween).share_found(), GetParam().least_found);
  EXPECT_LT(tallies.Of(EchoKind::kSurface).share_found(), GetParam().most_lost);
}

INSTANTIATE_TEST_SUITE_P(All, MixedPixelShare,
                         ::testing::Values(PlaceAndLidar{"street", "hdl32e", 0.35, 0.008},
                                           PlaceAndLidar{"street", "vlp16", 0.35, 0.015},
                                           PlaceAndLidar{"street", "os1_64", 0.3, 0.03},
                                           PlaceAndLidar{"garage", "hdl32e", 0.25, 0.004},
                                           PlaceAndLidar{"garage", "vlp16", 0.25, 0.005},
                                           PlaceAndLidar{"garage", "os1_64", 0.25, 0.01}),
                         [](const auto& test) {
                           return std::string(test.param.place) + "_" + test.param.lidar;
                         });

}  // namespace
}  // namespace lio::sim
