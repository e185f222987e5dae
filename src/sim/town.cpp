// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/town.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lio/base/angle.hpp"
#include "sim/movers.hpp"

namespace lio::sim {
namespace {

constexpr double kHouseSearch_m = 1.5;  // distance to the next try when a house does not fit

PathPoint OnFrontage(const Path& path, const Frontage& f, double along_m, double extra_m = 0.0) {
  return path.Beside(along_m, (f.on_left ? 1.0 : -1.0) * (f.offset_m + extra_m));
}

// Returns the heading from the frontage toward the path.
double FacingPath(const PathPoint& point, const Frontage& f) {
  return point.heading_rad + (f.on_left ? -0.5 : 0.5) * std::numbers::pi;
}

BuildingPlan PlanHouse(const HouseRow& row, double width_m, Random& random) {
  BuildingPlan plan;
  plan.size_m = {width_m, row.depth_m * random.Uniform(0.85, 1.15)};
  plan.num_storeys = random.Integer(row.min_storeys, row.max_storeys);
  plan.has_gable_roof = row.has_gable_roofs && random.Chance(0.85);
  plan.has_plain_rear = row.has_plain_rear;
  plan.facade = RandomFacade(random);
  if (row.has_gable_roofs) plan.facade.has_shops = false;
  if (row.has_gable_roofs) plan.facade.ground_storey_m = 2.9;
  return plan;
}

}  // namespace

Town::Town(World& world, Terrain terrain, RoadNetwork roads, const GroundOptions& ground,
           std::uint64_t seed)
    : world_(world),
      terrain_(std::move(terrain)),
      roads_(std::move(roads)),
      ground_(ground),
      random_(seed, Purpose::kWorld, 7) {
  AddGround(world_.fixed, terrain_, roads_, ground_);
}

double Town::GroundHeight(const Vector2& p_m) const {
  return terrain_.Height(p_m) + (roads_.SignedDistance(p_m) < 0.0 ? 0.0 : ground_.kerb_m);
}

void Town::Place(const Mesh& mesh, const Vector2& p_m, double heading_rad) {
  AddMesh(world_.fixed.page(), mesh,
          UprightPose({p_m.x(), p_m.y(), GroundHeight(p_m)}, heading_rad));
}

bool Town::Overlaps(const Footprint& a, const Footprint& b) {
  const Vector2 d = b.centre - a.centre;
  for (const Footprint* f : {&a, &b}) {
    for (const Vector2& axis : {f->axis, Vector2(-f->axis.y(), f->axis.x())}) {
      double reach = 0.0;
      for (const Footprint* g : {&a, &b}) {
        const Vector2 side(-g->axis.y(), g->axis.x());
        reach += g->half.x() * std::abs(axis.dot(g->axis)) + g->half.y() * std::abs(axis.dot(side));
      }
      if (std::abs(axis.dot(d)) > reach) return false;
    }
  }
  return true;
}

bool Town::Reserve(const Vector2& centre_m, double heading_rad, const Vector2& size_m,
                   double road_margin_m) {
  const Footprint place{centre_m, {std::cos(heading_rad), std::sin(heading_rad)}, 0.5 * size_m};
  const Vector2 side(-place.axis.y(), place.axis.x());
  for (int i = 0; i <= 4; ++i) {
    for (int j = 0; j <= 4; ++j) {
      const Vector2 p = centre_m + (0.5 * i - 1.0) * place.half.x() * place.axis +
                        (0.5 * j - 1.0) * place.half.y() * side;
      if (roads_.SignedDistance(p) < road_margin_m) return false;
    }
  }
  for (const Footprint& other : taken_) {
    if (Overlaps(place, other)) return false;
  }
  taken_.push_back(place);
  return true;
}

void Town::KeepClear(const Path& path, double width_m) {
  constexpr double kPiece_m = 2.0;
  for (double along_m = 0.5 * kPiece_m; along_m < path.length_m(); along_m += kPiece_m) {
    const PathPoint p = path.At(along_m);
    const Vector2 axis(std::cos(p.heading_rad), std::sin(p.heading_rad));
    taken_.push_back({p.position_m, axis, 0.5 * Vector2(kPiece_m, width_m)});
  }
}

void Town::AddHouses(const Path& path, const Frontage& f, const HouseRow& row) {
  double along_m = f.from_m;
  while (along_m < f.to_m) {
    const double width_m = random_.Uniform(row.min_width_m, row.max_width_m);
    const BuildingPlan plan = PlanHouse(row, width_m, random_);
    const double setback_m = random_.Uniform(0.0, row.max_setback_m);
    const PathPoint front = OnFrontage(path, f, along_m + 0.5 * width_m, setback_m);
    // The building's y axis points away from the path.
    const double heading = FacingPath(front, f) + 0.5 * std::numbers::pi;
    const Vector2 x_axis(std::cos(heading), std::sin(heading));
    const Vector2 y_axis(-x_axis.y(), x_axis.x());
    const Vector2 centre = front.position_m + 0.5 * plan.size_m.y() * y_axis;
    Random house = Random(random_.Bits(), Purpose::kWorld);
    if (!Reserve(centre, heading, plan.size_m - Vector2(0.02, 0.02), 2.0)) {
      along_m += kHouseSearch_m;
      continue;
    }
    Place(MakeBuilding(plan, house), front.position_m - 0.5 * width_m * x_axis, heading);
    along_m += width_m + 0.03;
    if (random_.Chance(row.gap_chance)) along_m += random_.Uniform(row.min_gap_m, row.max_gap_m);
  }
}

void Town::AddTrees(const Path& path, const Frontage& f, double spacing_m, double height_m) {
  for (double along_m = f.from_m; along_m < f.to_m;
       along_m += spacing_m * random_.Uniform(0.8, 1.2)) {
    const Mesh tree = MakeTree(height_m * random_.Uniform(0.75, 1.25), random_);
    const Vector2 p = OnFrontage(path, f, along_m, random_.Uniform(-0.2, 0.2)).position_m;
    if (Reserve(p, 0.0, {0.5, 0.5}, 0.3)) Place(tree, p, random_.Uniform(0.0, kTurn_rad));
  }
}

void Town::AddLamps(const Path& path, const Frontage& f, double spacing_m) {
  for (double along_m = f.from_m; along_m < f.to_m; along_m += spacing_m) {
    const PathPoint point = OnFrontage(path, f, along_m);
    if (!Reserve(point.position_m, 0.0, {0.3, 0.3}, 0.2)) continue;
    Place(MakeStreetLamp(7.5, 1.6), point.position_m, FacingPath(point, f));
  }
}

void Town::AddStreetThings(const Path& path, const Frontage& f, double spacing_m) {
  for (double along_m = f.from_m; along_m < f.to_m;
       along_m += spacing_m * random_.Uniform(0.5, 1.5)) {
    const PathPoint point = OnFrontage(path, f, along_m);
    const int kind = random_.Integer(0, 9);
    const double facing = FacingPath(point, f);
    const Vector2 size = kind >= 8 ? Vector2(1.8, 4.4) : Vector2(0.6, 0.6);
    const Vector2 place =
        kind >= 8 ? OnFrontage(path, f, along_m, 0.9).position_m : point.position_m;
    const Mesh sign = MakeSign(2.6, random_);
    if (!Reserve(place, facing, size, 0.2)) continue;
    if (kind < 3) {
      Place(sign, place, point.heading_rad + (f.on_left ? 0.0 : std::numbers::pi));
    } else if (kind < 5) {
      Place(MakeBin(), place, facing);
    } else if (kind < 7) {
      Place(MakeBollard(), place, facing);
    } else if (kind < 8) {
      Place(MakeBench(), place, facing);
    } else {
      Place(MakeBusShelter(), place, facing);
    }
  }
}

void Town::AddParkedCars(const Path& path, const Frontage& f, double share) {
  double along_m = f.from_m;
  while (along_m < f.to_m) {
    const VehicleKind kind = random_.Chance(0.15) ? VehicleKind::kVan : VehicleKind::kCar;
    const Mesh car = MakeVehicle(kind, random_);
    const double place_m = VehicleSize(kind).x() + random_.Uniform(0.6, 1.4);
    const bool taken = random_.Chance(share);
    const PathPoint point =
        OnFrontage(path, f, along_m + 0.5 * place_m, random_.Uniform(-0.12, 0.12));
    const double heading =
        point.heading_rad + (f.on_left ? std::numbers::pi : 0.0) + 0.02 * random_.Gaussian();
    along_m += place_m;
    // Cars are parked on the road by the kerb, and not in a crossing.
    const double edge_m = roads_.SignedDistance(point.position_m);
    if (taken && edge_m < -0.6 && edge_m > -1.7 &&
        Reserve(point.position_m, heading, VehicleSize(kind), -1e9)) {
      Place(car, point.position_m, heading);
    }
  }
}

void Town::AddHedges(const Path& path, const Frontage& f, double share) {
  constexpr double kPiece_m = 2.0;
  for (double along_m = f.from_m; along_m < f.to_m; along_m += kPiece_m) {
    const Mesh hedge = MakeBush({kPiece_m, 0.7, random_.Uniform(0.9, 1.5)}, random_);
    const PathPoint point = OnFrontage(path, f, along_m);
    if (!random_.Chance(share)) continue;
    if (Reserve(point.position_m, point.heading_rad, {0.95 * kPiece_m, 0.6}, 0.2)) {
      Place(hedge, point.position_m, point.heading_rad);
    }
  }
}

void Town::AddBarrier(const Path& path, const Frontage& f, double post_m, double low_m,
                      double high_m, Material material) {
  for (double along_m = f.from_m; along_m < f.to_m; along_m += post_m) {
    const auto foot = [&](double at_m) {
      const Vector2 p = OnFrontage(path, f, at_m).position_m;
      return Vector3(p.x(), p.y(), GroundHeight(p));
    };
    const Vector3 begin = foot(along_m);
    const Vector3 end = foot(std::min(along_m + post_m, f.to_m));
    const double heading = std::atan2(end.y() - begin.y(), end.x() - begin.x());
    AddBox(world_.fixed.page(), UprightPose(begin - Vector3(0, 0, 0.2), heading),
           {0.12, 0.12, high_m + 0.2}, Material::kMetal);
    const Vector3 out = 0.05 * Vector3(-std::sin(heading), std::cos(heading), 0.0);
    for (const double side : {-1.0, 1.0}) {
      AddQuad(world_.fixed.page(), begin + side * out + Vector3(0, 0, low_m),
              end + side * out + Vector3(0, 0, low_m), end + side * out + Vector3(0, 0, high_m),
              begin + side * out + Vector3(0, 0, high_m), material);
    }
  }
}

void Town::AddLaneMarks(const Path& path, const Frontage& f, double dash_m, double gap_m) {
  constexpr double kAbove_m = 0.012;  // above the coarser triangles of the road
  constexpr double kHalf_m = 0.07;
  constexpr double kPiece_m = 3.0;  // short pieces follow the ground
  const double period_m = gap_m > 0.0 ? dash_m + gap_m : kPiece_m;
  const double length_m = gap_m > 0.0 ? dash_m : kPiece_m;
  for (double along_m = f.from_m; along_m + length_m < f.to_m; along_m += period_m) {
    const auto at = [&](double at_m, double extra_m) {
      const Vector2 p = OnFrontage(path, f, at_m, extra_m).position_m;
      return Vector3(p.x(), p.y(), terrain_.Height(p) + kAbove_m);
    };
    AddQuad(world_.fixed.page(), at(along_m, -kHalf_m), at(along_m + length_m, -kHalf_m),
            at(along_m + length_m, kHalf_m), at(along_m, kHalf_m), Material::kMarking);
  }
}

void Town::AddStandingPeople(const Path& path, const Frontage& f, int num) {
  for (int i = 0; i < num; ++i) {
    const Mesh person = MakePerson(random_);
    const Vector2 p = OnFrontage(path, f, random_.Uniform(f.from_m, f.to_m)).position_m;
    const double heading = random_.Uniform(0.0, kTurn_rad);
    if (Reserve(p, 0.0, {0.6, 0.6}, 0.1)) Place(person, p, heading);
  }
}

void Town::AddWalkers(const Path& path, const Frontage& f, int num) {
  for (int i = 0; i < num; ++i) {
    const double middle_m = random_.Uniform(f.from_m, f.to_m);
    const double reach_m = random_.Uniform(8.0, 25.0);
    const double speed_mps = random_.Uniform(0.9, 1.6);
    const double phase_m = random_.Uniform(0.0, 4.0 * reach_m);
    Frontage lane = f;
    lane.offset_m += random_.Uniform(-0.5, 0.5);
    const double left_m = (lane.on_left ? 1.0 : -1.0) * lane.offset_m;
    const Terrain terrain = terrain_;
    const double kerb_m = ground_.kerb_m;
    // The walker goes there and back again; turning takes no time, which shows only in the walker's
    // own points.
    const auto body = [=](double t_s) {
      const double round_m = std::fmod(speed_mps * t_s + phase_m, 4.0 * reach_m);
      const bool back = round_m > 2.0 * reach_m;
      const double along_m = middle_m - reach_m + (back ? 4.0 * reach_m - round_m : round_m);
      const PathPoint p = path.Beside(along_m, left_m);
      const double z = terrain.Height(p.position_m) + kerb_m;
      return UprightPose({p.position_m.x(), p.position_m.y(), z},
                         p.heading_rad + (back ? std::numbers::pi : 0.0));
    };
    AddWalker(world_, random_, speed_mps, body);
  }
}

}  // namespace lio::sim
