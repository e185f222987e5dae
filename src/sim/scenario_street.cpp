// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes a street canyon: tall houses with shops close to the road, gentle bends, side streets, a
// stop at a traffic light and traffic both ways.
#include <cmath>
#include <utility>

#include "scenario_parts.hpp"

namespace lio::sim {
namespace {

constexpr double kHalfStreet_m = 5.6;  // two lanes and parked cars
constexpr double kStreetBefore_m =
    120.0;  // the street begins this much before the start and ends this much after the end
constexpr double kSideStreet_m = 130.0;  // distance from one side street to the next
constexpr double kStreetSpeed_mps = 10.0;

Path StreetPath(double length_m, Random& random) {
  Path path({-kStreetBefore_m, 0.0}, 0.0);
  path.AddStraight(kStreetBefore_m + 50.0);
  double turn = random.Chance(0.5) ? 1.0 : -1.0;
  while (path.length_m() < length_m + 2.0 * kStreetBefore_m) {
    const double radius_m = random.Uniform(90.0, 160.0);
    path.AddArc(radius_m, turn * random.Uniform(0.2, 0.45));
    path.AddStraight(random.Uniform(50.0, 110.0));
    turn = -turn;
  }
  return path;
}

std::vector<Road> StreetRoads(const Path& path) {
  std::vector<Road> roads = {{path.Sampled(4.0), kHalfStreet_m}};
  for (double s = kSideStreet_m; s < path.length_m(); s += kSideStreet_m) {
    const PathPoint p = path.At(s);
    roads.push_back({{p.position_m - 70.0 * p.Left(), p.position_m + 70.0 * p.Left()}, 3.6});
  }
  return roads;
}

void AddSides(Town& town, const Path& path) {
  town.AddLaneMarks(path, {0.0, path.length_m(), 0.0, true}, 3.0, 4.5);
  for (const bool left : {true, false}) {
    const auto frontage = [&](double offset_m) {
      return Frontage{4.0, path.length_m(), kHalfStreet_m + offset_m, left};
    };
    HouseRow row;
    row.max_storeys = 9;
    town.AddLamps(path, frontage(0.6), 28.0);
    town.AddTrees(path, frontage(0.9), 17.0, 7.0);
    town.AddStreetThings(path, frontage(0.7), 16.0);
    town.AddHouses(path, frontage(3.6), row);
    HouseRow rear;
    rear.max_storeys = 6;
    rear.gap_chance = 0.6;
    rear.max_gap_m = 14.0;
    rear.max_setback_m = 4.0;
    town.AddHouses(path, frontage(31.0), rear);
    town.AddTrees(path, frontage(23.0), 11.0, 8.0);
    town.AddParkedCars(path, frontage(-1.05), 0.55);
    town.AddStandingPeople(path, frontage(1.8), 20);
    const int num_walkers = static_cast<int>(path.length_m() / 35.0);
    town.AddWalkers(path, frontage(2.2), num_walkers);
  }
}

// Adds houses along the side streets, so that rays into them do not end in a field.
void AddSideStreets(Town& town, const std::vector<Road>& roads) {
  for (std::size_t i = 1; i < roads.size(); ++i) {
    const Vector2 along = roads[i].line_m[1] - roads[i].line_m[0];
    Path side(roads[i].line_m[0], std::atan2(along.y(), along.x()));
    side.AddStraight(along.norm());
    for (const bool left : {true, false}) {
      town.AddHouses(side, {0.0, side.length_m() - 8.0, roads[i].half_width_m + 2.6, left}, {});
      town.AddParkedCars(side, {0.0, side.length_m(), roads[i].half_width_m - 1.0, left}, 0.3);
    }
  }
}

// Adds cars ahead and behind that move like ours, and others in the oncoming lane.
void AddTraffic(World& world, const Path& ego, const Path& oncoming,
                const std::shared_ptr<const Drive>& drive, double duration_s,
                const HeightFunction& height, Random& random) {
  for (const double gap_m : {13.0, 24.0, -12.0}) {  // they make our stop, too, shifted by the gap
    const VehicleKind kind = random.Chance(0.3) ? VehicleKind::kVan : VehicleKind::kCar;
    AddVehicleMover(
        world, kind, random, ego,
        [drive, gap_m](double t_s) { return gap_m + drive->DistanceAt(t_s + 0.03 * gap_m); },
        height);
  }
  const double reach_m = oncoming.length_m() + 9.0 * duration_s;
  for (double back_m = 0.0; back_m < reach_m; back_m += random.Uniform(16.0, 60.0)) {
    const double u = random.Uniform();
    const VehicleKind kind =
        u < 0.12 ? VehicleKind::kBus : (u < 0.3 ? VehicleKind::kVan : VehicleKind::kCar);
    const double start_m = oncoming.length_m() - back_m;
    AddVehicleMover(
        world, kind, random, oncoming, [start_m](double t_s) { return start_m + 9.0 * t_s; },
        height);
  }
}

}  // namespace

Scenario MakeStreet(const ScenarioOptions& options) {
  Scenario scenario;
  const double duration_s = options.duration_s.value_or(60.0);
  scenario.duration_s = duration_s;
  Random random(options.seed, Purpose::kWorld, 1);
  const double planned_s = PlannedSeconds(scenario, options) + 20.0;
  const Path road = StreetPath(kStreetSpeed_mps * planned_s, random);
  const std::vector<Road> roads = StreetRoads(road);
  Terrain::Shape shape;
  shape.slope_ratio = {random.Uniform(-0.02, 0.02), random.Uniform(-0.01, 0.01)};
  const Terrain terrain(shape, random);
  Town town(scenario.world, terrain, RoadNetwork(roads), {}, options.seed);
  AddSides(town, road);
  AddSideStreets(town, roads);

  const Path ego = road.Shifted(-kTownLane_m).Cut(kStreetBefore_m, 1e9);
  const Path oncoming = road.Shifted(kTownLane_m).Reversed();
  DriveLimits limits;
  limits.speed_mps = kStreetSpeed_mps;
  const double light_m =
      2.0 * kSideStreet_m - kStreetBefore_m - 9.0;  // before the second side street
  const auto drive =
      std::make_shared<Drive>(ego, limits, std::vector<Stop>{{light_m, 4.0}}, kStartRest_s);
  const HeightFunction height = HeightOf(terrain);
  MotionPlan plan;
  plan.knot_interval_s = kCarKnot_s;
  plan.knots = FollowDrive(ego, *drive, height, {}, kCarKnot_s, planned_s);
  plan.oscillations = CarOscillations(options.seed);
  AddTraffic(scenario.world, ego, oncoming, drive, planned_s, height, random);
  MountOnCar(scenario, std::move(plan));
  scenario.view_width_m = 210.0;
  SetBegin(scenario, options, 6.0);
  return scenario;
}

}  // namespace lio::sim
