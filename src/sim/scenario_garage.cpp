// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes a multi-storey car park: the drive goes along the aisles and up a curved ramp from storey
// to storey, between columns, parked cars and low ceilings, with open sides.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lio/base/angle.hpp"
#include "scenario_parts.hpp"
#include "sim/unturned_pose.hpp"

namespace lio::sim {
namespace {

constexpr double kStraight_m =
    56.0;                          // length of the aisles, which begin at x = 0 at y = 0 and y = 18
constexpr double kRadius_m = 9.0;  // radius of the turns; the western one climbs
constexpr double kHalfRamp_m = 2.9;
constexpr double kStorey_m = 3.2;
constexpr double kSlab_m = 0.28;
constexpr double kEast_m = kStraight_m + kRadius_m + 4.0;
constexpr double kSouth_m = -9.0;
constexpr double kNorth_m = 2.0 * kRadius_m + 9.0;
constexpr double kStart_m = 6.0;  // start of the drive on the first aisle
constexpr double kLap_m = 2.0 * kStraight_m + kTurn_rad * kRadius_m;
constexpr double kRampFrom_m = 2.0 * kStraight_m + std::numbers::pi * kRadius_m;

Path Aisles(int num_laps) {
  Path path({0.0, 0.0}, 0.0);
  for (int i = 0; i < num_laps; ++i) {
    path.AddStraight(kStraight_m);
    path.AddArc(kRadius_m, std::numbers::pi);
    path.AddStraight(kStraight_m);
    path.AddArc(kRadius_m, std::numbers::pi);
  }
  return path.Cut(kStart_m, path.length_m());
}

double HeightAlong(double along_m) {
  const double laps = (along_m + kStart_m) / kLap_m;
  const double whole = std::floor(laps);
  const double in_lap_m = (laps - whole) * kLap_m;
  return kStorey_m *
         (whole + std::clamp((in_lap_m - kRampFrom_m) / (std::numbers::pi * kRadius_m), 0.0, 1.0));
}

// Adds the curved ramp up from a storey: its surface, underside and parapets.
void AddRamp(Mesh& mesh, double z) {
  constexpr int kPieces = 28;
  const auto at = [&](int i, double radius, double up) {
    const double angle = std::numbers::pi * (0.5 + static_cast<double>(i) / kPieces);
    return Vector3(radius * std::cos(angle), kRadius_m + radius * std::sin(angle),
                   z + kStorey_m * i / kPieces + up);
  };
  const double inner = kRadius_m - kHalfRamp_m;
  const double outer = kRadius_m + kHalfRamp_m;
  for (int i = 0; i < kPieces; ++i) {
    AddQuad(mesh, at(i, inner, 0), at(i, outer, 0), at(i + 1, outer, 0), at(i + 1, inner, 0),
            Material::kConcrete);
    AddQuad(mesh, at(i, inner, -kSlab_m), at(i, outer, -kSlab_m), at(i + 1, outer, -kSlab_m),
            at(i + 1, inner, -kSlab_m), Material::kConcrete);
    for (const double radius : {inner, outer}) {
      AddQuad(mesh, at(i, radius, -kSlab_m), at(i + 1, radius, -kSlab_m), at(i + 1, radius, 1.0),
              at(i, radius, 1.0), Material::kConcrete);
    }
  }
}

void AddParkedRow(Mesh& mesh, double y, double z, double heading, Random& random) {
  for (double x = 5.0; x < kStraight_m + 2.0; x += 2.6) {
    const VehicleKind kind = random.Chance(0.1) ? VehicleKind::kVan : VehicleKind::kCar;
    const Mesh car = MakeVehicle(kind, random);
    const double nose = heading + (random.Chance(0.4) ? std::numbers::pi : 0.0);
    const double turned = nose + 0.02 * random.Gaussian();
    const double in_bay = y + random.Uniform(-0.25, 0.25);
    if (std::fmod(x, 8.0) < 1.2 || !random.Chance(0.62))
      continue;  // a column stands here, or the place is free
    AddMesh(mesh, car, UprightPose({x, in_bay, z}, turned));
  }
}

// Adds the columns, some with a cabinet, and the beam and lamps below the ceiling at x.
void AddColumns(Mesh& mesh, double x, double z, double clear, Random& random) {
  for (const double y : {-3.4, 3.6, 14.4, 21.4}) {
    const double from_turn_m = std::hypot(x - kStraight_m, y - kRadius_m) - kRadius_m;
    if (x > kStraight_m && std::abs(from_turn_m) < kHalfRamp_m)
      continue;  // it would stand in the way
    AddBox(mesh, At(x, y, z), {0.5, 0.5, clear}, Material::kConcrete);
    if (!random.Chance(0.3)) continue;
    AddBox(mesh, At(x, y + (y < 9.0 ? -0.3 : 0.3), z + 1.4), {0.4, 0.06, 0.5}, Material::kRetro);
  }
  AddBox(mesh, At(x, 9.0, z + clear - 0.45), {0.4, kNorth_m - kSouth_m, 0.45}, Material::kConcrete);
  for (const double y : {1.6, 16.4}) {
    AddBox(mesh, At(x + 4.0, y, z + clear - 0.12), {1.5, 0.15, 0.1}, Material::kPlaster);
  }
}

// Adds columns and beams under a ceiling, parapets and a stair core.
void AddStructure(Mesh& mesh, double z, bool has_ceiling, Random& random) {
  const double clear = kStorey_m - kSlab_m;
  for (double x = 0.4; has_ceiling && x < kEast_m; x += 8.0) {
    AddColumns(mesh, x, z, clear, random);
  }
  for (const double y : {kSouth_m, kNorth_m}) {
    AddBox(mesh, At(0.5 * kEast_m, y, z), {kEast_m, 0.2, 1.1}, Material::kConcrete);
  }
  AddBox(mesh, At(kEast_m, 0.5 * (kSouth_m + kNorth_m), z), {0.2, kNorth_m - kSouth_m, 1.1},
         Material::kConcrete);
  for (const double y : {0.5 * (kSouth_m - kHalfRamp_m), kNorth_m - 0.5 * (9.0 - kHalfRamp_m)}) {
    AddBox(mesh, At(0.0, y, z), {0.2, 9.0 - kHalfRamp_m, 1.1}, Material::kConcrete);
  }
  AddBox(mesh, At(0.0, kRadius_m, z), {0.25, 2.0 * (kRadius_m - kHalfRamp_m), 1.1},
         Material::kConcrete);
  AddBox(mesh, At(kEast_m - 3.0, kNorth_m - 3.2, z), {5.0, 5.6, clear}, Material::kPlaster);
  AddBox(mesh, At(kEast_m - 5.52, kNorth_m - 3.2, z), {0.05, 1.0, 2.1}, Material::kCarPaintDark);
}

void AddStorey(World& world, int storey, bool has_ceiling, Random& random) {
  const double z = kStorey_m * storey;
  Mesh& mesh = world.fixed.page();
  if (storey > 0) {
    AddBox(mesh, At(0.5 * kEast_m, 0.5 * (kSouth_m + kNorth_m), z - kSlab_m),
           {kEast_m, kNorth_m - kSouth_m, kSlab_m}, Material::kConcrete);
  }
  AddStructure(mesh, z, has_ceiling, random);
  for (const double y : {-6.2, 6.4, 11.6, 24.2}) {
    AddParkedRow(mesh, y, z, 0.5 * std::numbers::pi, random);
    for (double x = 3.7; x < kStraight_m + 3.0; x += 2.6) {
      AddBox(mesh, At(x, y, z - 0.002), {0.09, 4.6, 0.006}, Material::kMarking);
    }
  }
  if (has_ceiling) AddRamp(mesh, z);
  for (int i = 0; i < 2; ++i) {
    const double x = random.Uniform(15.0, 45.0);
    const double y = random.Chance(0.5) ? 2.4 : 15.6;
    const double speed_mps = random.Uniform(0.9, 1.4);
    AddWalker(world, random, speed_mps, [=](double t_s) {
      const double reach_m = 10.0;
      const double round_m = std::fmod(speed_mps * t_s, 4.0 * reach_m);
      const bool back = round_m > 2.0 * reach_m;
      const double at_m = back ? 4.0 * reach_m - round_m : round_m;
      return UprightPose({x - reach_m + at_m, y, z}, back ? std::numbers::pi : 0.0);
    });
  }
}

// Adds the surroundings that can be seen through the open sides.
void AddSurroundings(World& world, std::uint64_t seed) {
  Random random(seed, Purpose::kWorld, 8);
  Terrain::Shape shape;
  shape.hill_m = 0.0;
  shape.bump_m = 0.0;
  const Terrain terrain(shape, random);
  Path around({-40.0, -40.0}, 0.0);
  around.AddStraight(150.0);
  Path behind({-40.0, 58.0}, 0.0);
  behind.AddStraight(150.0);
  Path lot({-30.0, kRadius_m}, 0.0);
  lot.AddStraight(kEast_m + 34.0);
  GroundOptions ground;
  ground.cell_m = 3.0;
  ground.kerb_m = 0.0;
  Town town(world, terrain,
            RoadNetwork({{around.Sampled(200.0), 4.0},
                         {behind.Sampled(200.0), 4.0},
                         {lot.Sampled(200.0), 0.5 * (kNorth_m - kSouth_m) + 4.0}}),
            ground, seed);
  HouseRow row;
  row.max_storeys = 6;
  for (const Path* street : {&around, &behind}) {
    const bool outward = street == &behind;
    town.AddHouses(*street, {0.0, street->length_m(), 8.0, outward}, row);
    town.AddTrees(*street, {0.0, street->length_m(), 5.5, outward}, 14.0, 8.0);
    town.AddTrees(*street, {0.0, street->length_m(), 5.5, !outward}, 18.0, 7.0);
    town.AddParkedCars(*street, {0.0, street->length_m(), 3.0, outward}, 0.5);
  }
}

}  // namespace

Scenario MakeGarage(const ScenarioOptions& options) {
  Scenario scenario;
  scenario.duration_s = options.duration_s.value_or(90.0);
  const double planned_s = PlannedSeconds(scenario, options);
  Random random(options.seed, Purpose::kWorld, 9);
  DriveLimits limits;
  limits.speed_mps = 5.5;
  limits.lateral_mps2 = 1.9;
  const int num_laps = 2 + static_cast<int>(planned_s * limits.speed_mps / kLap_m);
  const Path way = Aisles(num_laps);
  const auto drive = std::make_shared<const Drive>(
      way, limits, std::vector<Stop>{{44.0, 2.0}, {kLap_m + 30.0, 3.0}}, kStartRest_s);
  const double reached_m = drive->DistanceAt(planned_s) + 20.0;
  const int num_storeys = 2 + static_cast<int>(HeightAlong(reached_m) / kStorey_m);
  AddSurroundings(scenario.world, options.seed);
  for (int i = 0; i < num_storeys; ++i) {
    AddStorey(scenario.world, i, i + 1 < num_storeys, random);
  }
  const HeightFunction height = [](const Vector2&, double along_m) { return HeightAlong(along_m); };
  BodyResponse response;
  response.lively_speed_mps = 12.0;
  MotionPlan plan;
  plan.knot_interval_s = kCarKnot_s;
  plan.knots = FollowDrive(way, *drive, height, response, kCarKnot_s, planned_s);
  plan.oscillations = CarOscillations(options.seed);
  AddVehicleMover(
      scenario.world, VehicleKind::kCar, random, way,
      [drive](double t_s) { return 13.0 + drive->DistanceAt(t_s + 0.5); }, height);
  MountOnCar(scenario, std::move(plan));
  SetBegin(scenario, options, 3.0);
  return scenario;
}

}  // namespace lio::sim
