// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/building.hpp"

#include <algorithm>
#include <cmath>

namespace lio::sim {
namespace {

constexpr double kWallFoot_m = -3.0;  // depth to which walls reach into a slope

// A wall has its own coordinates: along it, up, and depth into the building.
struct FacadeWall {
  Vector3 origin;
  Vector3 along;  // unit vector, to the right seen from inside
  Vector3 inward;
  double length_m = 0.0;

  Vector3 At(double x, double z, double depth = 0.0) const {
    return origin + x * along + z * Vector3::UnitZ() + depth * inward;
  }
};

struct WallRectangle {
  double left = 0.0;
  double right = 0.0;
  double low = 0.0;
  double high = 0.0;
};

void AddRectangle(Mesh& mesh, const FacadeWall& wall, const WallRectangle& r, double depth,
                  Material material) {
  AddQuad(mesh, wall.At(r.left, r.low, depth), wall.At(r.right, r.low, depth),
          wall.At(r.right, r.high, depth), wall.At(r.left, r.high, depth), material);
}

// Adds a field of wall with a recessed opening in it.
void AddBay(Mesh& mesh, const FacadeWall& wall, const WallRectangle& bay, const WallRectangle& hole,
            double recess, Material material, Material pane) {
  AddRectangle(mesh, wall, {bay.left, hole.left, bay.low, bay.high}, 0.0, material);
  AddRectangle(mesh, wall, {hole.right, bay.right, bay.low, bay.high}, 0.0, material);
  AddRectangle(mesh, wall, {hole.left, hole.right, bay.low, hole.low}, 0.0, material);
  AddRectangle(mesh, wall, {hole.left, hole.right, hole.high, bay.high}, 0.0, material);
  AddRectangle(mesh, wall, hole, recess, pane);
  const auto reveal = [&](double x0, double z0, double x1, double z1) {
    AddQuad(mesh, wall.At(x0, z0), wall.At(x1, z1), wall.At(x1, z1, recess),
            wall.At(x0, z0, recess), material);
  };
  reveal(hole.left, hole.low, hole.left, hole.high);
  reveal(hole.right, hole.low, hole.right, hole.high);
  reveal(hole.left, hole.low, hole.right, hole.low);
  reveal(hole.left, hole.high, hole.right, hole.high);
}

// Adds a block that stands out of a wall (depth < 0) or is set into it.
void AddBlock(Mesh& mesh, const FacadeWall& wall, const WallRectangle& r, double from_depth,
              double to_depth, Material material) {
  AddRectangle(mesh, wall, r, from_depth, material);
  const auto side = [&](double x0, double z0, double x1, double z1) {
    AddQuad(mesh, wall.At(x0, z0, from_depth), wall.At(x1, z1, from_depth),
            wall.At(x1, z1, to_depth), wall.At(x0, z0, to_depth), material);
  };
  side(r.left, r.low, r.left, r.high);
  side(r.right, r.low, r.right, r.high);
  side(r.left, r.low, r.right, r.low);
  side(r.left, r.high, r.right, r.high);
}

void AddBalcony(Mesh& mesh, const FacadeWall& wall, const WallRectangle& bay) {
  const double out = -1.1;
  AddBlock(mesh, wall, {bay.left + 0.2, bay.right - 0.2, bay.low - 0.1, bay.low + 0.08}, out, 0.0,
           Material::kConcrete);
  AddBlock(mesh, wall, {bay.left + 0.2, bay.right - 0.2, bay.low + 0.08, bay.low + 1.05}, out,
           out + 0.06, Material::kMetal);
  for (const double x : {bay.left + 0.2, bay.right - 0.26}) {
    AddBlock(mesh, wall, {x, x + 0.06, bay.low + 0.08, bay.low + 1.05}, out, 0.0, Material::kMetal);
  }
}

// Adds one window bay, or a door if it has a balcony.
void AddUpperBay(Mesh& mesh, const FacadeWall& wall, const WallRectangle& bay,
                 const FacadeStyle& style, bool balcony, Random& random) {
  const double middle = 0.5 * (bay.left + bay.right);
  const double half = 0.5 * std::min(style.window_width_m, 0.8 * (bay.right - bay.left));
  const double low = bay.low + (balcony ? 0.1 : style.sill_m);
  const double high = std::min(bay.low + style.sill_m + style.window_height_m, bay.high - 0.2);
  AddBay(mesh, wall, bay, {middle - half, middle + half, low, high}, style.recess_m, style.wall,
         Material::kGlass);
  if (balcony) {
    AddBalcony(mesh, wall, bay);
  } else if (random.Chance(0.25)) {  // an air conditioner below the window
    AddBlock(mesh, wall, {middle - 0.35, middle + 0.35, low - 0.6, low - 0.1}, -0.32, 0.0,
             Material::kMetal);
  }
}

void AddGroundBay(Mesh& mesh, const FacadeWall& wall, const WallRectangle& bay,
                  const FacadeStyle& style, Random& random) {
  const bool door = random.Chance(0.25);
  const double margin = style.has_shops && !door ? 0.25 : 0.5 * (bay.right - bay.left) - 0.65;
  const double low = door ? 0.02 : (style.has_shops ? 0.35 : style.sill_m);
  const double high = std::min(
      style.has_shops ? bay.high - 0.9 : low + style.window_height_m + (door ? style.sill_m : 0.0),
      bay.high - 0.3);
  const WallRectangle hole{bay.left + margin, bay.right - margin, low, high};
  const double recess = style.has_shops || door ? 0.45 : style.recess_m;
  AddBay(mesh, wall, bay, hole, recess, style.wall, door ? Material::kWood : Material::kGlass);
  if (style.has_shops && !door && random.Chance(0.6)) {  // sign above the shop, some with awning
    AddBlock(mesh, wall, {bay.left + 0.15, bay.right - 0.15, bay.high - 0.75, bay.high - 0.15},
             -0.15, 0.0, Material::kMetal);
    if (random.Chance(0.5)) {
      AddQuad(mesh, wall.At(bay.left + 0.1, bay.high - 0.8),
              wall.At(bay.right - 0.1, bay.high - 0.8),
              wall.At(bay.right - 0.1, bay.high - 1.3, -1.2),
              wall.At(bay.left + 0.1, bay.high - 1.3, -1.2), Material::kCloth);
    }
  }
}

void AddFacade(Mesh& mesh, const FacadeWall& wall, const BuildingPlan& plan, Random& random) {
  const FacadeStyle& style = plan.facade;
  const int num_bays = std::max(1, static_cast<int>(wall.length_m / style.bay_m));
  const double bay_m = wall.length_m / num_bays;
  AddRectangle(mesh, wall, {0.0, wall.length_m, kWallFoot_m, 0.0}, 0.0, Material::kConcrete);
  std::vector<bool> balconies(static_cast<std::size_t>(num_bays));
  std::generate(balconies.begin(), balconies.end(),
                [&] { return random.Chance(style.balcony_chance); });
  double floor = 0.0;
  for (int storey = 0; storey < plan.num_storeys; ++storey) {
    const double height = storey == 0 ? style.ground_storey_m : style.storey_m;
    for (int b = 0; b < num_bays; ++b) {
      const WallRectangle bay{b * bay_m, (b + 1) * bay_m, floor, floor + height};
      if (storey == 0) {
        AddGroundBay(mesh, wall, bay, style, random);
      } else {
        AddUpperBay(mesh, wall, bay, style, balconies[static_cast<std::size_t>(b)], random);
      }
    }
    floor += height;
    if (storey == 0 || storey + 1 == plan.num_storeys) {  // string course and cornice
      AddBlock(mesh, wall, {0.0, wall.length_m, floor - 0.15, floor + 0.1}, -0.18, 0.0,
               Material::kConcrete);
    }
  }
}

double HeightOf(const BuildingPlan& plan) {
  return plan.facade.ground_storey_m + (plan.num_storeys - 1) * plan.facade.storey_m;
}

void AddFlatRoof(Mesh& mesh, const BuildingPlan& plan, Random& random) {
  const double h = HeightOf(plan);
  const double w = plan.size_m.x();
  const double d = plan.size_m.y();
  AddQuad(mesh, {0, 0, h}, {w, 0, h}, {w, d, h}, {0, d, h}, Material::kConcrete);
  const double parapet = 0.9;
  const std::array<std::array<double, 4>, 4> rims = {
      {{0, 0, w, 0.25}, {0, d - 0.25, w, d}, {0, 0, 0.25, d}, {w - 0.25, 0, w, d}}};
  for (const auto& r : rims) {
    AddPrism(mesh, {{r[0], r[1]}, {r[2], r[1]}, {r[2], r[3]}, {r[0], r[3]}}, h + 0.002, parapet,
             plan.facade.wall, Material::kConcrete);
  }
  if (w > 7.0 && d > 7.0) {  // stair head or lift machinery
    const double x = random.Uniform(1.5, w - 5.0);
    const double y = random.Uniform(2.0, d - 4.0);
    AddPrism(mesh, {{x, y}, {x + 3.2, y}, {x + 3.2, y + 2.6}, {x, y + 2.6}}, h, 2.5,
             plan.facade.wall, Material::kConcrete);
  }
}

void AddGableRoof(Mesh& mesh, const BuildingPlan& plan) {
  const double h = HeightOf(plan);
  const double w = plan.size_m.x();
  const double d = plan.size_m.y();
  const double ridge = h + 0.42 * d;
  const double eave = 0.45;  // overhang
  const double drop = eave * 0.84;
  for (const double side : {-1.0, 1.0}) {
    const double y = side < 0 ? -eave : d + eave;
    AddQuad(mesh, {-0.3, y, h - drop}, {w + 0.3, y, h - drop}, {w + 0.3, 0.5 * d, ridge},
            {-0.3, 0.5 * d, ridge}, Material::kRoofTile);
  }
  for (const double x : {0.0, w}) {
    AddTriangle(mesh, {x, 0, h}, {x, d, h}, {x, 0.5 * d, ridge}, plan.facade.wall);
  }
  AddBox(mesh, {Quaternion::Identity(), {0.3 * w, 0.42 * d, h + 0.2 * d}}, {0.6, 0.6, 0.3 * d},
         Material::kBrick);
}

}  // namespace

FacadeStyle RandomFacade(Random& random) {
  FacadeStyle style;
  constexpr std::array<Material, 5> kWalls = {Material::kPlaster, Material::kPlasterWarm,
                                              Material::kBrick, Material::kConcrete,
                                              Material::kPlaster};
  style.wall = kWalls[static_cast<std::size_t>(random.Integer(0, 4))];
  style.storey_m = random.Uniform(2.9, 3.6);
  style.ground_storey_m = random.Uniform(3.4, 4.6);
  style.bay_m = random.Uniform(2.4, 4.0);
  style.window_width_m = style.bay_m * random.Uniform(0.35, 0.65);
  style.window_height_m = random.Uniform(1.2, 1.9);
  style.sill_m = random.Uniform(0.6, 1.0);
  style.recess_m = random.Uniform(0.08, 0.35);
  style.balcony_chance = random.Chance(0.5) ? 0.0 : random.Uniform(0.2, 0.7);
  style.has_shops = random.Chance(0.6);
  return style;
}

Mesh MakeBuilding(const BuildingPlan& plan, Random& random) {
  Mesh mesh;
  const double w = plan.size_m.x();
  const double d = plan.size_m.y();
  const std::array<FacadeWall, 4> walls = {
      FacadeWall{{0, 0, 0}, Vector3::UnitX(), Vector3::UnitY(), w},
      FacadeWall{{w, 0, 0}, Vector3::UnitY(), -Vector3::UnitX(), d},
      FacadeWall{{w, d, 0}, -Vector3::UnitX(), -Vector3::UnitY(), w},
      FacadeWall{{0, d, 0}, -Vector3::UnitY(), Vector3::UnitX(), d}};
  const double h = HeightOf(plan);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (i > 0 && plan.has_plain_rear) {
      AddRectangle(mesh, walls[i], {0.0, walls[i].length_m, kWallFoot_m, h}, 0.0, plan.facade.wall);
    } else {
      AddFacade(mesh, walls[i], plan, random);
    }
  }
  if (plan.has_gable_roof) {
    AddGableRoof(mesh, plan);
  } else {
    AddFlatRoof(mesh, plan, random);
  }
  return mesh;
}

}  // namespace lio::sim
