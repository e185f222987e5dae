// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes a straight tunnel with plain walls, between two cuttings with trees, lamps and sign
// gantries. Inside, the position along the tunnel cannot be observed by the lidar.
#include <cmath>
#include <numbers>
#include <utility>

#include "scenario_parts.hpp"

namespace lio::sim {
namespace {

constexpr double kToPortal_m = 90.0;  // from the start to the portal
constexpr double kAfter_m = 160.0;    // length of open road beyond the far portal
constexpr double kHalfTunnelRoad_m = 4.2;
constexpr double kHalfTunnel_m = 5.4;
constexpr double kWall_m = 3.2;  // height at which the vault begins
constexpr double kTunnelSpeed_mps = 15.0;
constexpr double kSlope_ratio = 0.012;

double RoadHeight(double x_m) {
  return kSlope_ratio * x_m;
}

// Adds the inside of the tunnel from portal to portal, and the wall around each portal.
void AddTube(Mesh& mesh, double from_m, double to_m) {
  std::vector<Vector2> section = {{-kHalfTunnel_m, -0.5}, {-kHalfTunnel_m, kWall_m}};
  constexpr int kVault = 12;
  for (int i = 1; i < kVault; ++i) {
    const double angle = std::numbers::pi * (1.0 - static_cast<double>(i) / kVault);
    section.emplace_back(kHalfTunnel_m * std::cos(angle), kWall_m + 3.4 * std::sin(angle));
  }
  section.emplace_back(kHalfTunnel_m, kWall_m);
  section.emplace_back(kHalfTunnel_m, -0.5);
  const auto at = [&](double x, const Vector2& p) {
    return Vector3(x, p.x(), RoadHeight(x) + p.y());
  };
  constexpr double kPiece_m = 20.0;
  for (double x = from_m; x < to_m; x += kPiece_m) {
    const double next = std::min(x + kPiece_m, to_m);
    for (std::size_t i = 0; i + 1 < section.size(); ++i) {
      AddQuad(mesh, at(x, section[i]), at(next, section[i]), at(next, section[i + 1]),
              at(x, section[i + 1]), Material::kConcrete);
    }
  }
  for (const double x : {from_m, to_m}) {
    for (std::size_t i = 0; i + 1 < section.size(); ++i) {
      const auto outward = [](const Vector2& p) {
        return Vector2(2.6 * p.x(), p.y() < 0 ? -2.0 : 11.0);
      };
      AddQuad(mesh, at(x, section[i]), at(x, section[i + 1]), at(x, outward(section[i + 1])),
              at(x, outward(section[i])), Material::kConcrete);
    }
  }
}

// Adds a cutting: banks that rise beside the road, with bushes and trees.
void AddCutting(World& world, Town& town, double from_m, double to_m) {
  constexpr double kFoot_m = 9.0;
  constexpr double kTop_m = 24.0;
  const auto height = [&](double x, double y) {
    const double rise = 0.62 * (std::abs(y) - kFoot_m) + 0.25 * std::sin(0.31 * x + 0.2 * y) +
                        0.2 * std::sin(0.9 * x - 0.7 * y);
    return RoadHeight(x) + 0.05 + std::max(-0.4, rise);
  };
  const auto add_turf = [&](double x, double y, double side) {
    const auto at = [&](double dx, double dy) {
      return Vector3(x + dx, side * (y + dy), height(x + dx, side * (y + dy)));
    };
    AddQuad(world.fixed.page(), at(0, 0), at(2, 0), at(2, 2), at(0, 2), Material::kGrass);
  };
  for (const double side : {-1.0, 1.0}) {
    for (double x = from_m; x < to_m; x += 2.0) {
      for (double y = kFoot_m - 1.0; y < kTop_m; y += 2.0) add_turf(x, y, side);
    }
    Random& random = town.random();
    for (double x = from_m + 2.0; x < to_m; x += random.Uniform(2.0, 8.0)) {
      const double y = side * random.Uniform(kFoot_m + 1.0, kTop_m);
      const Mesh plant = random.Chance(0.5) ? MakeTree(random.Uniform(5.0, 9.0), random)
                                            : MakeBush({2.0, 2.0, 1.5}, random);
      AddMesh(world.fixed.page(), plant, UprightPose({x, y, height(x, y) - 0.1}, 0.0));
    }
  }
}

// Adds two posts and a beam with sign boards across the road.
void AddGantry(Mesh& mesh, double x) {
  const double z = RoadHeight(x);
  for (const double y : {-6.4, 6.4}) {
    AddBar(mesh, {x, y, z - 0.3}, {x, y, z + 6.6}, 0.16, 0.14, 8, Material::kMetal);
  }
  AddBox(mesh, UprightPose({x, 0.0, z + 6.2}, 0.0), {0.35, 12.8, 0.4}, Material::kMetal);
  for (const double y : {-2.2, 2.2}) {
    AddBox(mesh, UprightPose({x - 0.25, y, z + 5.6}, 0.0), {0.06, 3.0, 1.7}, Material::kRetro);
  }
}

void AddOutside(World& world, Town& town, const Path& road, double from_m, double to_m) {
  AddCutting(world, town, from_m, to_m);
  for (double x = from_m + 10.0; x < to_m - 10.0; x += 45.0) AddGantry(world.fixed.page(), x);
  const double offset_m = road.At(0.0).position_m.x();
  for (const bool left : {true, false}) {
    const Frontage side{from_m - offset_m + 4.0, to_m - offset_m - 3.0, kHalfTunnelRoad_m + 1.6,
                        left};
    town.AddLamps(road, side, 30.0);
    town.AddStreetThings(road, {side.from_m, side.to_m, kHalfTunnelRoad_m + 2.4, left}, 22.0);
  }
}

}  // namespace

Scenario MakeTunnel(const ScenarioOptions& options) {
  Scenario scenario;
  scenario.duration_s = options.duration_s.value_or(60.0);
  Random random(options.seed, Purpose::kWorld, 4);
  // The tunnel is as long as the log has time for, and the last 8 s are outside again.
  const double way_m = kTunnelSpeed_mps * std::max(20.0, scenario.duration_s - 7.0 - kStartRest_s);
  const double far_m = std::max(100.0, way_m - 8.0 * kTunnelSpeed_mps);
  Path road({-kToPortal_m - 100.0, 0.0}, 0.0);
  road.AddStraight(kToPortal_m + 100.0 + far_m + kAfter_m + 60.0);
  Terrain::Shape shape;
  shape.slope_ratio = {kSlope_ratio, 0.0};
  shape.hill_m = 0.0;
  shape.bump_m = 0.0;
  const Terrain terrain(shape, random);
  GroundOptions ground;
  ground.cell_m = 2.0;
  ground.reach_m = 8.0;
  ground.far_reach_m = 0.0;
  ground.pavement_m = 2.0;
  Town town(scenario.world, terrain, RoadNetwork({{road.Sampled(1000.0), kHalfTunnelRoad_m}}),
            ground, options.seed);
  AddTube(scenario.world.fixed.page(), 0.0, far_m);
  AddOutside(scenario.world, town, road, road.At(0.0).position_m.x(), 0.0);
  AddOutside(scenario.world, town, road, far_m, road.At(road.length_m()).position_m.x());

  const HeightFunction height = HeightOf(terrain);
  const Path ego = road.Shifted(-1.9).Cut(100.0, 1e9);
  DriveLimits limits;
  limits.speed_mps = kTunnelSpeed_mps;
  limits.accel_mps2 = 2.0;
  const auto drive = std::make_shared<const Drive>(ego, limits, std::vector<Stop>{}, kStartRest_s);
  MotionPlan plan;
  plan.knot_interval_s = kCarKnot_s;
  plan.knots = FollowDrive(ego, *drive, height, {}, kCarKnot_s, PlannedSeconds(scenario, options));
  plan.oscillations = CarOscillations(options.seed);
  const Path oncoming = road.Shifted(1.9).Reversed();
  for (double s = 0.0; s > -15.0 * scenario.duration_s; s -= random.Uniform(90.0, 220.0)) {
    AddVehicleMover(
        scenario.world, random.Chance(0.3) ? VehicleKind::kTruck : VehicleKind::kCar, random,
        oncoming,
        [s, length = oncoming.length_m()](double t_s) { return s + 0.7 * length + 15.0 * t_s; },
        height);
  }
  AddVehicleMover(
      scenario.world, VehicleKind::kVan, random, ego,
      [drive](double t_s) { return 22.0 + drive->DistanceAt(t_s + 1.0); }, height);
  MountOnCar(scenario, std::move(plan));
  scenario.ceiling_m = 3.6;
  scenario.view_width_m = 150.0;
  scenario.view_share = 0.16;
  scenario.ceiling_slope_ratio = {kSlope_ratio, 0.0};
  SetBegin(scenario, options, 6.0);
  return scenario;
}

}  // namespace lio::sim
