// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes a vehicle parked at the kerb near a crossing: cars, buses and people pass, while the
// vehicle moves only with the vibration of its idling engine.
#include <cmath>
#include <numbers>
#include <utility>

#include "scenario_parts.hpp"

namespace lio::sim {
namespace {

constexpr double kHalfCrossingRoad_m = 6.4;
constexpr double kReach_m = 150.0;       // length of the streets from the crossing
constexpr double kIdleVibration = 0.02;  // share of the body's motion when driving
constexpr double kParkedAt_m = -1.1;     // from the kerb toward the road

void AddStreet(Town& town, const Path& path) {
  for (const bool left : {true, false}) {
    const auto frontage = [&](double offset_m) {
      return Frontage{5.0, path.length_m() - 5.0, kHalfCrossingRoad_m + offset_m, left};
    };
    town.AddLamps(path, frontage(0.6), 27.0);
    town.AddTrees(path, frontage(1.1), 15.0, 8.0);
    town.AddStreetThings(path, frontage(0.8), 14.0);
    HouseRow row;
    row.max_storeys = 7;
    town.AddHouses(path, frontage(4.2), row);
    town.AddParkedCars(path, frontage(kParkedAt_m), 0.5);
    town.AddStandingPeople(path, frontage(2.2), 8);
    town.AddWalkers(path, frontage(2.5), 12);
  }
}

// Adds one lane of steady, endless traffic: vehicles that leave at the far end enter again.
void AddLane(World& world, const Path& lane, double speed_mps, const HeightFunction& height,
             Random& random) {
  const double length_m = lane.length_m();
  for (double start_m = 0.0; start_m < length_m - 15.0; start_m += random.Uniform(24.0, 60.0)) {
    const double u = random.Uniform();
    const VehicleKind kind = u < 0.2    ? VehicleKind::kBus
                             : u < 0.35 ? VehicleKind::kVan
                             : u < 0.42 ? VehicleKind::kTruck
                                        : VehicleKind::kCar;
    AddVehicleMover(
        world, kind, random, lane,
        [=](double t_s) { return std::fmod(start_m + speed_mps * t_s, length_m); }, height);
  }
}

}  // namespace

Scenario MakeParked(const ScenarioOptions& options) {
  Scenario scenario;
  scenario.duration_s = options.duration_s.value_or(60.0);
  Random random(options.seed, Purpose::kWorld, 3);
  Path along({-kReach_m, 0.0}, 0.0);
  along.AddStraight(2.0 * kReach_m);
  Path across({35.0, -kReach_m}, 0.5 * std::numbers::pi);
  across.AddStraight(2.0 * kReach_m);
  Terrain::Shape shape;
  shape.slope_ratio = {random.Uniform(-0.03, 0.03), random.Uniform(-0.02, 0.02)};
  const Terrain terrain(shape, random);
  const std::vector<Road> roads = {{along.Sampled(50.0), kHalfCrossingRoad_m},
                                   {across.Sampled(50.0), kHalfCrossingRoad_m}};
  Town town(scenario.world, terrain, RoadNetwork(roads), {}, options.seed);
  const Path ego = along.Shifted(-kHalfCrossingRoad_m - kParkedAt_m).Cut(kReach_m, 2.0 * kReach_m);
  town.Reserve(ego.At(0.0).position_m, 0.0, {7.0, 2.4}, -1e9);  // our own place at the kerb
  town.AddLaneMarks(along, {0.0, along.length_m(), 0.0, true}, 3.0, 4.5);
  AddStreet(town, along);
  AddStreet(town, across);

  const HeightFunction height = HeightOf(terrain);
  MotionPlan plan;
  plan.knot_interval_s = kCarKnot_s;
  const Drive standing(ego, {}, {}, PlannedSeconds(scenario, options));
  plan.knots = FollowDrive(ego, standing, height, {}, kCarKnot_s, scenario.duration_s);
  for (BodyKnot& knot : plan.knots) knot.liveliness = kIdleVibration;
  plan.oscillations = CarOscillations(options.seed);
  AddLane(scenario.world, along.Shifted(-2.2), 11.0, height, random);
  AddLane(scenario.world, along.Shifted(2.2).Reversed(), 9.5, height, random);
  MountOnCar(scenario, std::move(plan));
  SetBegin(scenario, {options.seed, options.duration_s, false, {}}, 0.0);
  return scenario;
}

}  // namespace lio::sim
