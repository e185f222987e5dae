// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes a drive once around a city block: it has four streets of different character and two stops,
// and ends exactly where it began. Longer logs go round again.
#include <algorithm>
#include <cmath>
#include <utility>

#include "scenario_parts.hpp"

namespace lio::sim {
namespace {

constexpr double kBlockLength_m = 224.0;  // length of the block between road middles
constexpr double kBlockWidth_m = 132.0;
constexpr double kHalfBlockRoad_m = 5.4;
constexpr double kBeyond_m = 90.0;  // length of the streets beyond the crossings
constexpr double kEndRest_s = 2.0;

// The path goes clockwise, so that driving on the right is on the inside; it begins in the middle
// of a long side.
Path BlockPath() {
  return Path::Rounded({{0.0, 0.0},
                        {0.5 * kBlockLength_m, 0.0},
                        {0.5 * kBlockLength_m, -kBlockWidth_m},
                        {-0.5 * kBlockLength_m, -kBlockWidth_m},
                        {-0.5 * kBlockLength_m, 0.0}},
                       9.2, true);
}

std::vector<Road> BlockRoads() {
  const double x = 0.5 * kBlockLength_m;
  const double x_end = x + kBeyond_m;
  const double y_end = kBlockWidth_m + kBeyond_m;
  return {{{{-x_end, 0.0}, {x_end, 0.0}}, kHalfBlockRoad_m},
          {{{-x_end, -kBlockWidth_m}, {x_end, -kBlockWidth_m}}, kHalfBlockRoad_m},
          {{{-x, kBeyond_m}, {-x, -y_end}}, kHalfBlockRoad_m},
          {{{x, kBeyond_m}, {x, -y_end}}, kHalfBlockRoad_m}};
}

void AddSide(Town& town, const Road& road, int character) {
  const Vector2 along = road.line_m[1] - road.line_m[0];
  Path path(road.line_m[0], std::atan2(along.y(), along.x()));
  path.AddStraight(along.norm());
  town.AddLaneMarks(path, {0.0, path.length_m(), 0.0, true}, 3.0, 4.5);
  HouseRow row;
  row.min_storeys = character == 1 ? 2 : 3;
  row.max_storeys = character == 0 ? 9 : 6;
  row.depth_m = 13.0;
  row.gap_chance = character == 2 ? 0.3 : 0.1;
  for (const bool left : {true, false}) {
    const auto frontage = [&](double offset_m) {
      return Frontage{6.0, path.length_m() - 6.0, kHalfBlockRoad_m + offset_m, left};
    };
    town.AddLamps(path, frontage(0.6), 30.0);
    if (character != 1) town.AddTrees(path, frontage(1.0), character == 2 ? 10.0 : 19.0, 7.5);
    town.AddStreetThings(path, frontage(0.7), 18.0);
    town.AddHouses(path, frontage(3.8), row);
    town.AddParkedCars(path, frontage(-1.05), character == 3 ? 0.3 : 0.6);
    town.AddStandingPeople(path, frontage(2.0), 8);
    town.AddWalkers(path, frontage(2.3), 6);
  }
}

void AddCourtyard(Town& town) {
  for (int i = 0; i < 60; ++i) {
    const double y_m = -town.random().Uniform(30.0, 100.0);
    const Vector2 p(town.random().Uniform(-80.0, 80.0), y_m);
    const Mesh tree = MakeTree(town.random().Uniform(6.0, 11.0), town.random());
    if (town.Reserve(p, 0.0, {3.0, 3.0}, 2.0)) town.Place(tree, p, 0.0);
  }
}

// Adds cars that go round and round in the oncoming lane.
void AddOncoming(World& world, const Path& block, const HeightFunction& height, Random& random) {
  const Path lane = block.Shifted(kTownLane_m).Reversed();
  const double lap_m = lane.length_m();
  for (double start_m = 20.0; start_m < lap_m - 12.0; start_m += random.Uniform(35.0, 90.0)) {
    const VehicleKind kind = random.Chance(0.2) ? VehicleKind::kVan : VehicleKind::kCar;
    AddVehicleMover(
        world, kind, random, lane,
        [=](double t_s) { return std::fmod(start_m + 6.5 * t_s, lap_m); }, height);
  }
}

Drive PlanLaps(const Path& lap, int num_laps) {
  DriveLimits limits;
  limits.speed_mps = 10.0;
  std::vector<Stop> stops;
  for (int i = 0; i < num_laps; ++i) {
    const double from_m = i * lap.length_m();
    stops.push_back({from_m + 0.5 * kBlockLength_m - 16.0, 3.0});
    stops.push_back({from_m + 1.5 * kBlockLength_m + kBlockWidth_m - 22.0, 2.0});
  }
  return Drive(lap.Repeated(num_laps), limits, stops, kStartRest_s);
}

}  // namespace

Scenario MakeLoop(const ScenarioOptions& options) {
  Scenario scenario;
  Random random(options.seed, Purpose::kWorld, 2);
  const Path block = BlockPath();
  Terrain::Shape shape;
  shape.slope_ratio = {random.Uniform(0.01, 0.025), random.Uniform(-0.02, 0.02)};
  shape.hill_m = 1.2;
  const Terrain terrain(shape, random);
  const std::vector<Road> roads = BlockRoads();
  Town town(scenario.world, terrain, RoadNetwork(roads), {}, options.seed);
  for (const double side : {-1.0, 1.0}) town.KeepClear(block.Shifted(side * kTownLane_m), 2.3);
  for (std::size_t i = 0; i < roads.size(); ++i) AddSide(town, roads[i], static_cast<int>(i));
  AddCourtyard(town);

  const Path lap = block.Shifted(-kTownLane_m);
  int num_laps = 1;
  auto drive = std::make_shared<const Drive>(PlanLaps(lap, num_laps));
  scenario.duration_s = options.duration_s.value_or(drive->duration_s() + kEndRest_s);
  while (drive->duration_s() + kEndRest_s < scenario.duration_s) {
    drive = std::make_shared<const Drive>(PlanLaps(lap, ++num_laps));
  }
  const Path way = lap.Repeated(num_laps);
  const HeightFunction height = HeightOf(terrain);
  MotionPlan plan;
  plan.knot_interval_s = kCarKnot_s;
  plan.knots = FollowDrive(way, *drive, height, {}, kCarKnot_s, PlannedSeconds(scenario, options));
  plan.oscillations = CarOscillations(options.seed);
  AddOncoming(scenario.world, block, height, random);
  AddVehicleMover(
      scenario.world, VehicleKind::kCar, random, lap.Repeated(num_laps + 1),
      [drive](double t_s) { return 14.0 + drive->DistanceAt(t_s + 0.5); }, height);
  MountOnCar(scenario, std::move(plan));
  SetBegin(scenario, options, 6.0);
  return scenario;
}

}  // namespace lio::sim
