// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes an open suburb: a winding road over low hills, detached houses with gable roofs behind
// hedges and lawns, garden trees, and cars in the drives.
#include <cmath>
#include <numbers>
#include <utility>

#include "scenario_parts.hpp"

namespace lio::sim {
namespace {

constexpr double kHalfSuburbRoad_m = 4.8;  // two lanes and a few parked cars
constexpr double kSuburbBefore_m = 80.0;
constexpr double kSuburbSpeed_mps = 11.0;

Path WindingRoad(double length_m, Random& random) {
  Path path({-kSuburbBefore_m, 0.0}, 0.0);
  path.AddStraight(kSuburbBefore_m + 35.0);
  double heading = 0.0;
  while (path.length_m() < length_m + 2.0 * kSuburbBefore_m) {
    const double angle = random.Uniform(0.35, 1.0);
    double turn = random.Chance(0.5) ? angle : -angle;
    if (std::abs(heading + turn) > 0.9) turn = -turn;  // the road never turns back on itself
    path.AddArc(random.Uniform(35.0, 80.0), turn);
    path.AddStraight(random.Uniform(15.0, 60.0));
    heading += turn;
  }
  return path;
}

void AddDrives(Town& town, const Path& road, bool left) {
  Random& random = town.random();
  for (double s = 5.0; s < road.length_m(); s += random.Uniform(14.0, 32.0)) {
    const Mesh car = MakeVehicle(VehicleKind::kCar, random);
    const double offset_m = kHalfSuburbRoad_m + random.Uniform(5.2, 6.5);
    const PathPoint p = road.Beside(s, left ? offset_m : -offset_m);
    const double heading = p.heading_rad + (random.Chance(0.5) ? 0.5 : -0.5) * std::numbers::pi;
    if (town.Reserve(p.position_m, heading, {5.2, 2.4}, 1.2)) {
      town.Place(car, p.position_m, heading);
    }
  }
}

void AddGardens(Town& town, const Path& road) {
  HouseRow row;
  row.min_storeys = 1;
  row.max_storeys = 2;
  row.min_width_m = 8.5;
  row.max_width_m = 13.0;
  row.depth_m = 9.0;
  row.gap_chance = 1.0;
  row.min_gap_m = 6.0;
  row.max_gap_m = 16.0;
  row.max_setback_m = 4.0;
  row.has_gable_roofs = true;
  row.has_plain_rear = false;
  for (const bool left : {true, false}) {
    const auto frontage = [&](double offset_m) {
      return Frontage{2.0, road.length_m(), kHalfSuburbRoad_m + offset_m, left};
    };
    town.AddLamps(road, frontage(0.5), 42.0);
    town.AddHouses(road, frontage(9.0), row);
    AddDrives(town, road, left);
    town.AddHedges(road, frontage(2.6), 0.55);
    town.AddTrees(road, frontage(5.5), 19.0, 6.5);
    town.AddTrees(road, frontage(24.0), 13.0, 9.5);
    town.AddParkedCars(road, frontage(-1.0), 0.08);
    town.AddStreetThings(road, frontage(1.6), 45.0);
    town.AddStandingPeople(road, frontage(4.0), 10);
    town.AddWalkers(road, frontage(1.2), 5);
  }
}

}  // namespace

Scenario MakeSuburb(const ScenarioOptions& options) {
  Scenario scenario;
  scenario.duration_s = options.duration_s.value_or(70.0);
  const double planned_s = PlannedSeconds(scenario, options);
  Random random(options.seed, Purpose::kWorld, 5);
  const Path road = WindingRoad(kSuburbSpeed_mps * planned_s, random);
  Terrain::Shape shape;
  shape.slope_ratio = {random.Uniform(-0.015, 0.015), 0.0};
  shape.hill_m = 5.0;
  shape.bump_m = 0.02;
  const Terrain terrain(shape, random);
  GroundOptions ground;
  ground.pavement_m = 2.0;
  ground.kerb_m = 0.09;
  ground.far_reach_m = 200.0;
  Town town(scenario.world, terrain, RoadNetwork({{road.Sampled(4.0), kHalfSuburbRoad_m}}), ground,
            options.seed);
  AddGardens(town, road);

  const HeightFunction height = HeightOf(terrain);
  const Path ego = road.Shifted(-1.6).Cut(kSuburbBefore_m, 1e9);
  DriveLimits limits;
  limits.speed_mps = kSuburbSpeed_mps;
  const auto drive =
      std::make_shared<const Drive>(ego, limits, std::vector<Stop>{{210.0, 2.5}}, kStartRest_s);
  MotionPlan plan;
  plan.knot_interval_s = kCarKnot_s;
  plan.knots = FollowDrive(ego, *drive, height, {}, kCarKnot_s, planned_s);
  plan.oscillations = CarOscillations(options.seed);
  const Path oncoming = road.Shifted(1.6).Reversed();
  for (double back_m = 40.0; back_m < oncoming.length_m() + 9.0 * planned_s;
       back_m += random.Uniform(60.0, 180.0)) {
    AddVehicleMover(
        scenario.world, random.Chance(0.2) ? VehicleKind::kVan : VehicleKind::kCar, random,
        oncoming, [s = oncoming.length_m() - back_m](double t_s) { return s + 9.0 * t_s; }, height);
  }
  MountOnCar(scenario, std::move(plan));
  scenario.view_width_m = 200.0;
  SetBegin(scenario, options, 6.0);
  return scenario;
}

}  // namespace lio::sim
