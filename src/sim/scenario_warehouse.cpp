// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes the warehouse: a hall of equal racks with pallets, aisles of 3 m between them, a wide aisle
// at either end, people on foot and fork lifts. The way goes up and down the aisles.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "carrier.hpp"
#include "sim/movers.hpp"

namespace lio::sim {
namespace {

constexpr int kRows = 6;    // rows of double racks
constexpr int kBays = 14;   // in a row
constexpr int kLevels = 4;  // pallets, one above the other
constexpr double kBay_m = 2.7;
constexpr double kLevel_m = 1.75;
constexpr double kDepth_m = 2.3;  // depth of a double rack
constexpr double kAisle_m = 3.0;
constexpr double kPitch_m = kDepth_m + kAisle_m;
constexpr double kRow_m = kBays * kBay_m;
constexpr double kEnd_m = 6.0;  // from the racks to the hall's ends
constexpr double kWarehouseHeight_m = 9.5;
constexpr double kHalfWarehouse_m = 0.5 * (kRows + 1) * kPitch_m;

double RackMiddle(int row) {
  return (row - 0.5 * (kRows - 1)) * kPitch_m;
}

double AisleMiddle(int aisle) {
  return (aisle - 0.5 * kRows) * kPitch_m;
}

void AddHall(Mesh& mesh) {
  const double low_x = -kEnd_m;
  const double high_x = kRow_m + kEnd_m;
  const double y = kHalfWarehouse_m;
  AddQuad(mesh, {low_x, -y, 0}, {high_x, -y, 0}, {high_x, y, 0}, {low_x, y, 0},
          Material::kConcrete);
  AddQuad(mesh, {low_x, -y, kWarehouseHeight_m}, {high_x, -y, kWarehouseHeight_m},
          {high_x, y, kWarehouseHeight_m}, {low_x, y, kWarehouseHeight_m}, Material::kMetal);
  for (const double side : {-1.0, 1.0}) {
    AddQuad(mesh, {low_x, side * y, 0}, {high_x, side * y, 0},
            {high_x, side * y, kWarehouseHeight_m}, {low_x, side * y, kWarehouseHeight_m},
            Material::kMetal);
    const double x = side < 0.0 ? low_x : high_x;
    AddQuad(mesh, {x, -y, 0}, {x, y, 0}, {x, y, kWarehouseHeight_m}, {x, -y, kWarehouseHeight_m},
            Material::kBrick);
  }
  for (double x = low_x + 6.0; x < high_x; x += 12.0) {  // roof girders
    AddBox(mesh, UprightPose({x, 0.0, kWarehouseHeight_m - 0.8}, 0.0), {0.3, 2.0 * y, 0.5},
           Material::kMetal);
  }
  for (double gate_m = -y + 5.0; gate_m < y - 4.0; gate_m += 9.0) {  // loading gates
    AddBox(mesh, UprightPose({low_x + 0.05, gate_m, 0.0}, 0.0), {0.1, 3.2, 3.6},
           Material::kCarPaintBlue);
  }
}

// A pallet with goods, in its rack: most are full, some half, some places are empty.
void AddPallet(Mesh& mesh, const Vector3& at_m, Random& random) {
  const double fill = random.Uniform();
  if (fill < 0.15) return;
  const double yaw = random.Uniform(-0.02, 0.02);
  AddBox(mesh, UprightPose(at_m, yaw), {1.2, 0.8, 0.14}, Material::kWood);
  const double height_m = fill < 0.35 ? random.Uniform(0.3, 0.8) : 1.25;
  AddBox(mesh, UprightPose(at_m + Vector3(0.0, 0.0, 0.14), yaw), {1.15, 0.78, height_m},
         random.Chance(0.6) ? Material::kPaving : Material::kPlaster);
}

void AddRack(Mesh& mesh, double y, Random& random) {
  for (int bay = 0; bay <= kBays; ++bay) {
    for (const double side : {-1.1, -0.1, 0.1, 1.1}) {
      AddBox(mesh, UprightPose({bay * kBay_m, y + side, 0.0}, 0.0),
             {0.1, 0.09, kLevels * kLevel_m + 0.4}, Material::kCarPaintBlue);
    }
  }
  for (int level = 0; level < kLevels; ++level) {
    const double z = level * kLevel_m;
    for (const double side : {-1.1, -0.1, 0.1, 1.1}) {
      if (level == 0) continue;
      AddBox(mesh, UprightPose({0.5 * kRow_m, y + side, z - 0.12}, 0.0), {kRow_m, 0.05, 0.12},
             Material::kCarPaintRed);
    }
    for (int place = 0; place < 2 * kBays; ++place) {
      for (const double side : {-0.6, 0.6}) {
        AddPallet(mesh, {(place + 0.5) * 0.5 * kBay_m, y + side, z}, random);
      }
    }
  }
}

Mesh MakeForkLift() {
  Mesh mesh;
  const auto at = [](double x, double y, double z) { return UprightPose({x, y, z}, 0.0); };
  AddBox(mesh, at(-0.4, 0.0, 0.15), {1.6, 1.1, 0.8}, Material::kCarPaintRed);
  for (const double y : {-0.45, 0.45}) {
    AddBox(mesh, at(0.45, y, 0.1), {0.12, 0.1, 2.3}, Material::kDarkMetal);
    AddBox(mesh, at(-0.9, y, 0.9), {0.06, 0.06, 1.2}, Material::kDarkMetal);
    AddBox(mesh, at(1.0, 0.5 * y, 0.1), {1.0, 0.12, 0.05}, Material::kDarkMetal);
  }
  AddBox(mesh, at(-0.3, 0.0, 2.1), {1.3, 1.0, 0.05}, Material::kDarkMetal);
  AddBox(mesh, at(1.05, 0.0, 0.15), {1.2, 0.8, 1.2}, Material::kPaving);
  return mesh;
}

// Goes to and fro between two ends, and turns around at each.
Pose Shuttle(const Vector2& from, const Vector2& to, double speed_mps, double phase, double t_s) {
  const double length_m = (to - from).norm();
  const double lap = std::fmod(speed_mps * t_s / length_m + phase, 2.0);
  const double share = lap < 1.0 ? lap : 2.0 - lap;
  const Vector2 p = from + share * (to - from);
  const Vector2 ahead = lap < 1.0 ? to - from : from - to;
  return UprightPose({p.x(), p.y(), 0.0}, std::atan2(ahead.y(), ahead.x()));
}

// People and fork lifts keep to one side of their aisles, so the way passes by them.
void AddTraffic(World& world, Random& random) {
  for (int aisle = 0; aisle <= kRows; ++aisle) {
    const double y = AisleMiddle(aisle) + (random.Chance(0.5) ? 0.95 : -0.95);
    const double from = random.Uniform(0.0, 0.3 * kRow_m);
    const double to = random.Uniform(0.6 * kRow_m, kRow_m);
    const double speed_mps = random.Uniform(0.8, 1.4);
    const double phase = random.Uniform(0.0, 2.0);
    AddWalker(world, random, speed_mps, [=](double t_s) {
      return Shuttle({from, y}, {to, y}, speed_mps, phase, t_s);
    });
  }
  for (const double x : {-kEnd_m + 1.6, kRow_m + kEnd_m - 1.6}) {
    world.shapes.push_back(MakeForkLift());
    const double phase = random.Uniform(0.0, 2.0);
    world.movers.push_back({world.shapes.size() - 1, [=](double t_s) {
                              return Shuttle({x, -kHalfWarehouse_m + 2.5},
                                             {x, kHalfWarehouse_m - 2.5}, 2.2, phase, t_s);
                            }});
  }
}

// The way leads up one aisle and down the next, from the first aisle on, in a loop over all of
// them.
Path Way(double length_m) {
  constexpr double kTurn_m = 2.2;  // from the racks' ends to the way across
  std::vector<Vector2> points = {{1.0, AisleMiddle(1)}};
  for (int aisle = 1; aisle < kRows; ++aisle) {
    const double x = aisle % 2 == 1 ? kRow_m + kTurn_m : -kTurn_m;
    points.emplace_back(x, AisleMiddle(aisle));
    points.emplace_back(x, AisleMiddle(aisle + 1));
  }
  points.emplace_back(-kTurn_m, points.back().y());
  points.emplace_back(-kTurn_m, AisleMiddle(1));
  const Path lap = Path::Rounded(points, 1.2, true);
  return lap.Repeated(1 + static_cast<int>(length_m / lap.length_m()));
}

}  // namespace

Scenario MakeWarehouse(const ScenarioOptions& options) {
  const Carrier carrier = options.carrier.value_or(Carrier::kRobot);
  Scenario scenario;
  scenario.duration_s = options.duration_s.value_or(100.0);
  Random random(options.seed, Purpose::kWorld, 14);
  AddHall(scenario.world.fixed.page());
  for (int row = 0; row < kRows; ++row)
    AddRack(scenario.world.fixed.page(), RackMiddle(row), random);
  AddTraffic(scenario.world, random);
  const Path way = Way(LimitsOf(carrier).speed_mps * PlannedSeconds(scenario, options));
  const auto floor = [](const Vector2&, double) { return 0.0; };
  CarryAlong(scenario, carrier, way, floor, 2.0, options);
  scenario.lidar_model = "vlp16";
  scenario.ceiling_m = 4.0;
  SetBegin(scenario, options, 0.8);
  return scenario;
}

}  // namespace lio::sim
