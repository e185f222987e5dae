// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes a lane of tilled soil between clipped hedges, as in a nursery: nothing but the soil's own
// shape tells how far along the lane one is.
#include <cmath>

#include "carrier.hpp"

namespace lio::sim {
namespace {

constexpr double kHalfLane_m = 2.2;
constexpr double kHedgeHeight_m = 1.7;
constexpr double kHedgeDepth_m = 0.9;
constexpr double kHedgePiece_m = 2.0;
constexpr double kLaneBeyond_m =
    110.0;  // before the start and after the end; no beam reaches the ends

void AddHedge(World& world, const Terrain& terrain, const Path& lane, double left_m) {
  const auto foot = [&](double along_m) {
    const Vector2 p = lane.Beside(along_m, left_m).position_m;
    return Vector3(p.x(), p.y(), terrain.Height(p));
  };
  for (double at_m = 0.0; at_m < lane.length_m(); at_m += kHedgePiece_m) {
    const Vector3 from = foot(at_m);
    const Vector3 to = foot(at_m + kHedgePiece_m);
    const Vector3 up = (kHedgeHeight_m + 0.3) * Vector3::UnitZ();
    const Vector3 across = Vector3::UnitZ().cross((to - from).normalized());
    const Vector3 half = 0.5 * kHedgeDepth_m * across;
    const Vector3 low = -0.3 * Vector3::UnitZ();
    for (const double side : {-1.0, 1.0}) {
      AddQuad(world.fixed.page(), from + side * half + low, to + side * half + low,
              to + side * half + low + up, from + side * half + low + up, Material::kHedge);
    }
    AddQuad(world.fixed.page(), from - half + low + up, to - half + low + up, to + half + low + up,
            from + half + low + up, Material::kHedge);
  }
}

}  // namespace

Scenario MakeHedgerows(const ScenarioOptions& options) {
  const Carrier carrier = options.carrier.value_or(Carrier::kRobot);
  Scenario scenario;
  scenario.duration_s = options.duration_s.value_or(80.0);
  Random random(options.seed, Purpose::kWorld, 15);
  const double way_m = LimitsOf(carrier).speed_mps * PlannedSeconds(scenario, options);
  Path lane({-kLaneBeyond_m, 0.0}, 0.0);
  lane.AddStraight(way_m + 2.0 * kLaneBeyond_m);
  Terrain::Shape shape;
  shape.slope_ratio = {random.Uniform(-0.05, 0.05), random.Uniform(-0.01, 0.01)};
  shape.hill_m = 0.5;
  const Terrain terrain(shape, random);
  GroundOptions ground;
  ground.cell_m = 0.8;
  ground.reach_m = 8.0;
  ground.far_reach_m = 40.0;
  ground.kerb_m = 0.0;
  ground.road = ground.pavement = Material::kSoil;
  AddGround(scenario.world.fixed, terrain, RoadNetwork({{lane.Sampled(4.0), kHalfLane_m}}), ground);
  for (const double side : {-1.0, 1.0}) {
    for (const int row : {0, 1}) {
      AddHedge(
          scenario.world, terrain, lane,
          side * (kHalfLane_m + 0.5 * kHedgeDepth_m + row * (2.0 * kHalfLane_m + kHedgeDepth_m)));
    }
  }
  const Path way = lane.Cut(kLaneBeyond_m, 1e9);
  CarryAlong(scenario, carrier, way, HeightOf(terrain), 1.0, options);
  scenario.lidar_model = "vlp16";
  scenario.view_width_m = 60.0;
  SetBegin(scenario, options, 0.8);
  return scenario;
}

}  // namespace lio::sim
