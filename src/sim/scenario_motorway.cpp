// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes a motorway: the drive goes from the hard shoulder onto three lanes at 28 m/s, with guard
// rails, lamps, gantries, bridges and noise barriers, slower trucks and faster cars around, and the
// other carriageway.
#include <algorithm>
#include <cmath>
#include <utility>

#include "scenario_parts.hpp"

namespace lio::sim {
namespace {

constexpr double kHalfMotorway_m = 16.0;  // half the width of both carriageways
constexpr double kShoulder_m =
    -14.2;  // this and the next are offsets to the left of the road's middle
constexpr double kSlowLane_m = -11.0;
constexpr double kOwnLane_m = -7.4;
constexpr double kFastLane_m = -3.8;
constexpr double kMotorwayBefore_m = 150.0;
constexpr double kMotorwaySpeed_mps = 28.0;
constexpr double kMergeFrom_m = 90.0;  // begin of the lane change from the shoulder, along the way
constexpr double kMergeTo_m = 330.0;

Path Carriageway(double length_m, Random& random) {
  Path path({-kMotorwayBefore_m, 0.0}, 0.0);
  path.AddStraight(kMotorwayBefore_m + 200.0);
  double turn = random.Chance(0.5) ? 1.0 : -1.0;
  while (path.length_m() < length_m + 2.0 * kMotorwayBefore_m) {
    const double angle = turn * random.Uniform(0.15, 0.35);
    path.AddArc(random.Uniform(600.0, 900.0), angle);
    path.AddStraight(random.Uniform(80.0, 250.0));
    turn = -turn;
  }
  return path;
}

// Adds a bridge over the road: deck, parapets, abutments and a pier in the median.
void AddBridge(Mesh& mesh, const PathPoint& p, double z) {
  const double heading = p.heading_rad;
  const auto at = [&](double along, double left, double up) {
    const Vector2 q = p.position_m + along * p.Forward() + left * p.Left();
    return UprightPose({q.x(), q.y(), z + up}, heading);
  };
  AddBox(mesh, at(0.0, 0.0, 5.6), {10.0, 56.0, 1.1}, Material::kConcrete);
  for (const double side : {-4.8, 4.8}) {
    AddBox(mesh, at(side, 0.0, 6.7), {0.3, 56.0, 1.0}, Material::kConcrete);
    AddBar(mesh, at(0.6 * side, 0.0, -0.3).translation, at(0.6 * side, 0.0, 5.7).translation, 0.45,
           0.45, 12, Material::kConcrete);
  }
  for (const double side : {-21.0, 21.0}) {
    AddBox(mesh, at(0.0, side, -1.0), {10.0, 2.0, 6.7}, Material::kConcrete);
  }
}

void AddGantry(Mesh& mesh, const PathPoint& p, double z) {
  const auto at = [&](double along, double left, double up) {
    const Vector2 q = p.position_m + along * p.Forward() + left * p.Left();
    return UprightPose({q.x(), q.y(), z + up}, p.heading_rad);
  };
  for (const double side : {-17.2, -0.9}) {
    AddBar(mesh, at(0.0, side, -0.3).translation, at(0.0, side, 7.0).translation, 0.2, 0.17, 10,
           Material::kMetal);
  }
  AddBox(mesh, at(0.0, -9.0, 6.6), {0.4, 17.0, 0.6}, Material::kMetal);
  for (const double lane : {kSlowLane_m, kOwnLane_m, kFastLane_m}) {
    AddBox(mesh, at(-0.3, lane, 5.9), {0.08, 2.8, 2.2}, Material::kRetro);
  }
}

void AddFurniture(World& world, Town& town, const Path& road) {
  Random& random = town.random();
  const double end_m = road.length_m();
  for (const double lane : {kSlowLane_m + 1.8, kOwnLane_m + 1.8}) {
    for (const bool left : {true, false}) {
      town.AddLaneMarks(road, {0.0, end_m, -lane, left}, 6.0, 12.0);
    }
  }
  for (const bool left : {true, false}) {
    town.AddLaneMarks(road, {0.0, end_m, 12.9, left}, 0.0, 0.0);
    town.AddBarrier(road, {0.0, end_m, 0.9, left}, 4.0, 0.45, 0.78, Material::kMetal);
    town.AddBarrier(road, {0.0, end_m, 16.4, left}, 4.0, 0.45, 0.78, Material::kMetal);
    for (double s = random.Uniform(0.0, 300.0); s < end_m; s += random.Uniform(300.0, 600.0)) {
      town.AddBarrier(road, {s, std::min(end_m, s + random.Uniform(80.0, 220.0)), 18.5, left}, 5.0,
                      0.0, 3.6, Material::kWood);
    }
    town.AddTrees(road, {0.0, end_m, 22.0, left}, 17.0, 8.0);
    town.AddTrees(road, {0.0, end_m, 30.0, left}, 11.0, 11.0);
    town.AddHedges(road, {0.0, end_m, 19.6, left}, 0.12);
  }
  for (double s = 20.0; s < end_m; s += 45.0) {
    const PathPoint p = road.At(s);
    town.Place(MakeStreetLamp(11.0, 2.5), p.position_m, p.heading_rad + 1.5708);
    town.Place(MakeStreetLamp(11.0, 2.5), p.position_m, p.heading_rad - 1.5708);
  }
  for (double s = kMotorwayBefore_m + 260.0; s < end_m; s += random.Uniform(350.0, 550.0)) {
    const PathPoint p = road.At(s);
    AddBridge(world.fixed.page(), p, town.GroundHeight(p.position_m));
  }
  for (double s = kMotorwayBefore_m + 120.0; s < end_m; s += random.Uniform(400.0, 700.0)) {
    const PathPoint p = road.At(s);
    AddGantry(world.fixed.page(), p, town.GroundHeight(p.position_m));
  }
}

// Returns the progress from the shoulder to our lane, 0 to 1, smooth, and its slope by distance.
double MergeShare(double along_m, double& slope_per_m) {
  const double x = std::clamp((along_m - kMergeFrom_m) / (kMergeTo_m - kMergeFrom_m), 0.0, 1.0);
  slope_per_m = 30.0 * x * x * (1.0 - x) * (1.0 - x) / (kMergeTo_m - kMergeFrom_m);
  return x * x * x * (10.0 - 15.0 * x + 6.0 * x * x);
}

void ShiftIntoLane(std::vector<BodyKnot>& knots, const Drive& drive, const Path& shoulder) {
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const double along_m = drive.DistanceAt(kCarKnot_s * static_cast<double>(i));
    double slope = 0.0;
    const double left_m = (kOwnLane_m - kShoulder_m) * MergeShare(along_m, slope);
    knots[i].position_m.head<2>() += left_m * shoulder.At(along_m).Left();
    knots[i].yaw_rad += std::atan((kOwnLane_m - kShoulder_m) * slope);
  }
}

// Adds a lane of vehicles that keep their speed; `keeps_clear(start)` says which of them may be
// there.
void AddLane(World& world, const Path& lane, double speed_mps, double duration_s, double gap_m,
             double truck_share, const HeightFunction& height, Random& random,
             const std::function<bool(double start_m)>& keeps_clear) {
  for (double s = lane.length_m(); s > -speed_mps * duration_s;
       s -= gap_m * random.Uniform(0.5, 1.6)) {
    const bool truck = random.Chance(truck_share);
    if (!keeps_clear(s)) continue;
    AddVehicleMover(
        world, truck ? VehicleKind::kTruck : VehicleKind::kCar, random, lane,
        [s, speed_mps](double t_s) { return s + speed_mps * t_s; }, height);
  }
}

void AddTraffic(World& world, const Path& road, const Drive& drive, double duration_s,
                const HeightFunction& height, Random& random) {
  // Vehicles that would touch ours while it crosses the slow lane are left out.
  const auto clear_of_us = [&](double start_m) {
    for (double t_s = 0.0; t_s < duration_s; t_s += 0.25) {
      const double own_m = drive.DistanceAt(t_s);
      if (own_m < kMergeFrom_m - 30.0 || own_m > kMergeTo_m + 30.0) continue;
      if (std::abs(start_m + 23.0 * t_s - kMotorwayBefore_m - own_m) < 25.0) return false;
    }
    return true;
  };
  const auto always = [](double) { return true; };
  AddLane(world, road.Shifted(kSlowLane_m), 23.0, duration_s, 70.0, 0.7, height, random,
          clear_of_us);
  AddLane(world, road.Shifted(kFastLane_m), 34.0, duration_s, 110.0, 0.0, height, random, always);
  AddLane(world, road.Shifted(-kSlowLane_m).Reversed(), 23.0, duration_s, 80.0, 0.7, height, random,
          always);
  AddLane(world, road.Shifted(-kOwnLane_m).Reversed(), 29.0, duration_s, 90.0, 0.1, height, random,
          always);
  AddLane(world, road.Shifted(-kFastLane_m).Reversed(), 35.0, duration_s, 120.0, 0.0, height,
          random, always);
}

}  // namespace

Scenario MakeMotorway(const ScenarioOptions& options) {
  Scenario scenario;
  scenario.duration_s = options.duration_s.value_or(60.0);
  const double planned_s = PlannedSeconds(scenario, options);
  Random random(options.seed, Purpose::kWorld, 6);
  const Path road = Carriageway(kMotorwaySpeed_mps * planned_s, random);
  Terrain::Shape shape;
  shape.slope_ratio = {random.Uniform(-0.01, 0.01), random.Uniform(-0.01, 0.01)};
  shape.hill_m = 1.5;
  shape.bump_m = 0.008;
  const Terrain terrain(shape, random);
  GroundOptions ground;
  ground.cell_m = 2.0;
  ground.reach_m = 30.0;
  ground.far_reach_m = 200.0;
  ground.kerb_m = 0.0;
  ground.pavement_m = 0.0;
  Town town(scenario.world, terrain, RoadNetwork({{road.Sampled(20.0), kHalfMotorway_m}}), ground,
            options.seed);
  AddFurniture(scenario.world, town, road);

  const HeightFunction height = HeightOf(terrain);
  const Path shoulder = road.Shifted(kShoulder_m).Cut(kMotorwayBefore_m, 1e9);
  DriveLimits limits;
  limits.speed_mps = kMotorwaySpeed_mps;
  limits.accel_mps2 = 2.2;
  const Drive drive(shoulder, limits, {}, kStartRest_s);
  MotionPlan plan;
  plan.knot_interval_s = kCarKnot_s;
  const HeightFunction height_of_lane = [&](const Vector2& p_m, double along_m) {
    double slope = 0.0;
    const double left_m = (kOwnLane_m - kShoulder_m) * MergeShare(along_m, slope);
    return terrain.Height(p_m + left_m * shoulder.At(along_m).Left());
  };
  plan.knots = FollowDrive(shoulder, drive, height_of_lane, {}, kCarKnot_s, planned_s);
  ShiftIntoLane(plan.knots, drive, shoulder);
  plan.oscillations = CarOscillations(options.seed);
  AddTraffic(scenario.world, road, drive, planned_s, height, random);
  MountOnCar(scenario, std::move(plan));
  scenario.view_width_m = 230.0;
  SetBegin(scenario, options, 20.0);
  return scenario;
}

}  // namespace lio::sim
