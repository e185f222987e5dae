// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes the campus: a walk around its lawn with a hand-held sensor, between long buildings, through
// an arcade, past trees, benches, lamps and many people.
#include <cmath>
#include <utility>

#include "scenario_parts.hpp"

namespace lio::sim {
namespace {

constexpr double kHalfWay_m = 1.9;      // half the footpath's width
constexpr double kLawnLength_m = 62.0;  // length of the way around the lawn
constexpr double kLawnWidth_m = 38.0;
constexpr double kCampusKnot_s = 0.2;

Path WayAroundLawn() {
  return Path::Rounded({{0.0, 0.0},
                        {0.5 * kLawnLength_m, 0.0},
                        {0.5 * kLawnLength_m, 0.42 * kLawnWidth_m},
                        {0.5 * kLawnLength_m - 9.0, 0.6 * kLawnWidth_m},
                        {0.5 * kLawnLength_m - 9.0, kLawnWidth_m},
                        {-0.5 * kLawnLength_m, kLawnWidth_m},
                        {-0.5 * kLawnLength_m, 0.0}},
                       2.6, true);
}

// Adds columns and a roof over the northern side of the way.
void AddArcade(World& world, const Town& town) {
  const double y = kLawnWidth_m;
  const double from = -0.5 * kLawnLength_m + 6.0;
  const double to = 0.5 * kLawnLength_m - 16.0;
  const double floor = town.GroundHeight({0.5 * (from + to), y});
  for (double x = from; x <= to; x += 3.6) {
    for (const double side : {-2.1, 2.1}) {
      const double foot = town.GroundHeight({x, y + side});
      AddBox(world.fixed.page(), UprightPose({x, y + side, foot - 0.2}, 0.0), {0.55, 0.55, 0.5},
             Material::kConcrete);
      AddBar(world.fixed.page(), {x, y + side, foot + 0.3}, {x, y + side, floor + 3.6}, 0.19, 0.17,
             12, Material::kPlaster);
    }
  }
  AddBox(world.fixed.page(), UprightPose({0.5 * (from + to), y, floor + 3.5}, 0.0),
         {to - from + 1.2, 5.2, 0.4}, Material::kConcrete);
}

// Adds a stand with bicycles, made of hoops and wheels.
void AddBicycles(Town& town, const Vector2& at, int num) {
  Mesh mesh;
  Random& random = town.random();
  for (int i = 0; i < num; ++i) {
    const double x = 0.75 * i;
    AddBar(mesh, {x, -0.35, 0.0}, {x, -0.35, 0.8}, 0.025, 0.025, 6, Material::kMetal);
    AddBar(mesh, {x, 0.35, 0.0}, {x, 0.35, 0.8}, 0.025, 0.025, 6, Material::kMetal);
    AddBar(mesh, {x, -0.35, 0.8}, {x, 0.35, 0.8}, 0.025, 0.025, 6, Material::kMetal);
    if (!random.Chance(0.7)) continue;
    for (const double y : {-0.55, 0.5}) {
      AddBar(mesh, {x + 0.18, y, 0.34}, {x + 0.22, y, 0.34}, 0.34, 0.34, 12, Material::kRubber);
    }
    AddBar(mesh, {x + 0.2, -0.55, 0.4}, {x + 0.2, 0.4, 0.95}, 0.025, 0.025, 6, Material::kCarPaint);
    AddBar(mesh, {x + 0.2, 0.45, 0.4}, {x + 0.2, 0.35, 1.05}, 0.025, 0.025, 6, Material::kCarPaint);
  }
  town.Place(mesh, at, 0.0);
}

void AddLawn(World& world, Town& town) {
  Random& random = town.random();
  const Vector2 middle(-4.0, 0.5 * kLawnWidth_m);
  Mesh basin;  // a fountain
  AddBar(basin, {0, 0, -0.2}, {0, 0, 0.55}, 3.0, 3.0, 24, Material::kConcrete);
  AddBar(basin, {0, 0, 0.5}, {0, 0, 2.2}, 0.5, 0.25, 12, Material::kConcrete);
  if (town.Reserve(middle, 0.0, {6.2, 6.2}, 1.0)) town.Place(basin, middle, 0.0);
  for (int i = 0; i < 26; ++i) {
    const double y_m = random.Uniform(5.0, kLawnWidth_m - 5.0);
    const Vector2 p(random.Uniform(-26.0, 22.0), y_m);
    const Mesh tree = MakeTree(random.Uniform(6.0, 11.0), random);
    const Mesh person = MakePerson(random);
    if (i % 3 == 0) {
      if (town.Reserve(p, 0.0, {0.6, 0.6}, 1.0)) town.Place(person, p, random.Uniform(0.0, 6.28));
    } else if (town.Reserve(p, 0.0, {3.5, 3.5}, 2.0)) {
      town.Place(tree, p, 0.0);
    }
  }
  AddBicycles(town, {8.0, -4.2}, 10);
  AddArcade(world, town);
}

void AddEdges(Town& town, const Path& way) {
  HouseRow row;
  row.min_storeys = 2;
  row.max_storeys = 4;
  row.min_width_m = 20.0;
  row.max_width_m = 34.0;
  row.depth_m = 14.0;
  row.gap_chance = 0.8;
  row.max_gap_m = 9.0;
  row.max_setback_m = 3.0;
  row.has_plain_rear = false;
  const double end_m = way.length_m();
  town.AddHouses(way, {0.0, end_m, 9.0, false}, row);
  town.AddHouses(way, {0.0, end_m, 34.0, false}, row);
  for (const bool left : {true, false}) {
    town.AddLamps(way, {3.0, end_m, kHalfWay_m + 0.8, left}, 21.0);
    town.AddStreetThings(way, {0.0, end_m, kHalfWay_m + 0.9, left}, 9.0);
    town.AddWalkers(way, {0.0, end_m, 1.1, left}, 8);
  }
  town.AddTrees(way, {0.0, end_m, 5.5, false}, 12.0, 7.0);
  town.AddHedges(way, {0.0, end_m, 7.4, false}, 0.5);
}

}  // namespace

Scenario MakeCampus(const ScenarioOptions& options) {
  Scenario scenario;
  scenario.duration_s = options.duration_s.value_or(80.0);
  const double planned_s = PlannedSeconds(scenario, options);
  Random random(options.seed, Purpose::kWorld, 10);
  const Path lap = WayAroundLawn();
  Terrain::Shape shape;
  shape.slope_ratio = {random.Uniform(-0.015, 0.015), random.Uniform(-0.02, 0.02)};
  shape.hill_m = 0.7;
  const Terrain terrain(shape, random);
  GroundOptions ground;
  ground.cell_m = 0.8;
  ground.kerb_m = 0.0;
  ground.pavement_m = 0.3;
  ground.road = Material::kPaving;
  Town town(scenario.world, terrain, RoadNetwork({{lap.Sampled(1.5), kHalfWay_m}}), ground,
            options.seed);
  AddLawn(scenario.world, town);
  AddEdges(town, lap);

  DriveLimits limits;
  limits.speed_mps = 1.35;
  limits.accel_mps2 = 0.7;
  limits.brake_mps2 = 0.9;
  limits.lateral_mps2 = 0.55;
  const Path way =
      lap.Repeated(1 + static_cast<int>(planned_s * limits.speed_mps / lap.length_m()));
  const Drive drive(way, limits, {{38.0, 2.0}}, kStartRest_s);
  BodyResponse response;
  response.lean_rad_per_mps2 = 0.0;
  response.dive_rad_per_mps2 = 0.01;
  response.half_wheelbase_m = 0.0;
  response.lively_speed_mps = 1.2;
  MotionPlan plan;
  plan.knot_interval_s = kCampusKnot_s;
  plan.knots = FollowDrive(way, drive, HeightOf(terrain), response, kCampusKnot_s, planned_s);
  plan.oscillations = WalkOscillations(options.seed);
  MountOnPerson(scenario, std::move(plan));
  scenario.ceiling_m = 1e9;
  SetBegin(scenario, options, 0.9);
  return scenario;
}

}  // namespace lio::sim
