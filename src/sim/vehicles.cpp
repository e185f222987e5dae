// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <cmath>

#include "sim/props.hpp"
#include "sim/unturned_pose.hpp"

namespace lio::sim {
namespace {

Material Paint(Random& random) {
  constexpr std::array<Material, 8> kPaints = {Material::kCarPaint,     Material::kCarPaint,
                                               Material::kCarPaintGrey, Material::kCarPaintGrey,
                                               Material::kCarPaintDark, Material::kCarPaintDark,
                                               Material::kCarPaintRed,  Material::kCarPaintBlue};
  return kPaints[static_cast<std::size_t>(random.Integer(0, 7))];
}

void AddWheels(Mesh& mesh, double front_x, double rear_x, double half_width, double radius) {
  for (const double x : {front_x, rear_x}) {
    for (const double side : {-1.0, 1.0}) {
      const double outer = side * (half_width + 0.01);
      AddBar(mesh, {x, outer - 0.22 * side, radius}, {x, outer, radius}, radius, radius, 12,
             Material::kRubber);
      AddBar(mesh, {x, outer, radius}, {x, outer + 0.005 * side, radius}, 0.6 * radius,
             0.6 * radius, 8, Material::kMetal);
    }
  }
}

// Adds the rounded part of a car's body: its side view is extruded over its width with a
// tumblehome.
void AddHull(Mesh& mesh, const std::vector<Vector2>& profile_xz, double half_width, double belt_z,
             Material paint) {
  const auto at = [&](std::size_t i, double side) {
    const Vector2& p = profile_xz[i % profile_xz.size()];
    const double narrow = p.y() > belt_z ? 0.06 : (p.y() < 0.3 ? 0.04 : 0.0);
    return Vector3(p.x(), side * (half_width - narrow), p.y());
  };
  for (std::size_t i = 0; i < profile_xz.size(); ++i) {
    AddQuad(mesh, at(i, -1.0), at(i + 1, -1.0), at(i + 1, 1.0), at(i, 1.0), paint);
  }
  for (const double side : {-1.0, 1.0}) {
    for (std::size_t i = 1; i + 1 < profile_xz.size(); ++i) {
      AddTriangle(mesh, at(0, side), at(i, side), at(i + 1, side), paint);
    }
  }
}

Mesh MakeCar(Random& random) {
  Mesh mesh;
  const double length = random.Uniform(4.0, 4.8);
  const double half_width = random.Uniform(0.86, 0.93);
  const double roof = random.Uniform(1.42, 1.62);
  const bool estate = random.Chance(0.5);
  const Material paint = Paint(random);
  const double f = 0.5 * length;
  const double belt = 0.88;
  AddHull(mesh,
          {{0.0, 0.22},
           {f - 0.25, 0.24},
           {f, 0.4},
           {f - 0.04, 0.66},
           {f - 0.95, belt},
           {-f + (estate ? 0.05 : 0.6), belt + 0.04},
           {-f + 0.02, belt},
           {-f, 0.45},
           {-f + 0.2, 0.24}},
          half_width, 0.8, paint);
  Taper cabin;
  cabin.bottom_m = {estate ? length - 1.1 : length - 1.7, 2.0 * half_width - 0.12};
  cabin.top_m = {cabin.bottom_m.x() - (estate ? 0.9 : 1.2), 2.0 * half_width - 0.42};
  cabin.top_shift_m = {estate ? -0.28 : -0.1, 0.0};
  cabin.height_m = roof - belt;
  AddTaper(mesh, At(estate ? -0.5 : -0.2, 0, belt), cabin, Material::kGlass, paint);
  for (const double side : {-1.0, 1.0}) {
    AddBox(mesh, At(f - 1.4, side * (half_width + 0.06), 0.9), {0.12, 0.16, 0.13}, paint);
    AddBox(mesh, At(f - 0.06, 0.6 * side, 0.58), {0.1, 0.3, 0.12}, Material::kGlass);
    AddBox(mesh, At(-f + 0.03, 0.62 * side, 0.68), {0.05, 0.25, 0.14}, Material::kRetro);
  }
  AddBox(mesh, At(-f - 0.01, 0, 0.5), {0.02, 0.5, 0.11}, Material::kRetro);
  AddWheels(mesh, 0.3 * length, -0.3 * length, half_width, 0.31);
  return mesh;
}

Mesh MakeVan(Random& random) {
  Mesh mesh;
  const Material paint = Paint(random);
  const double half = 0.95;
  AddHull(mesh,
          {{0.0, 0.3},
           {2.5, 0.32},
           {2.6, 0.6},
           {2.5, 1.05},
           {1.95, 1.25},
           {1.35, 2.15},
           {-2.55, 2.2},
           {-2.6, 0.5},
           {-2.4, 0.3}},
          half, 1.3, paint);
  AddQuad(mesh, {1.97, -0.8, 1.28}, {1.97, 0.8, 1.28}, {1.43, 0.78, 2.08}, {1.43, -0.78, 2.08},
          Material::kGlass);
  for (const double side : {-1.0, 1.0}) {
    AddBox(mesh, At(1.0, side * (half - 0.04), 1.3), {0.9, 0.02, 0.6}, Material::kGlass);
    AddBox(mesh, At(1.75, side * (half + 0.08), 1.25), {0.12, 0.2, 0.25}, Material::kDarkMetal);
    AddBox(mesh, At(-2.6, 0.8 * side, 0.8), {0.03, 0.15, 0.4}, Material::kRetro);
  }
  AddWheels(mesh, 1.65, -1.6, half, 0.34);
  return mesh;
}

Mesh MakeBus(Random& random) {
  Mesh mesh;
  const double length = 11.6;
  const double height = random.Chance(0.35) ? 4.3 : 3.05;  // some have two decks
  const Material paint = Paint(random);
  AddBox(mesh, At(0, 0, 0.32), {length, 2.5, height - 0.32}, paint);
  for (double deck = 1.05; deck + 1.0 < height; deck += 1.95) {
    for (const double side : {-1.0, 1.0}) {
      for (int i = 0; i < 7; ++i) {
        AddBox(mesh, At(-4.8 + 1.6 * i, side * 1.245, deck), {1.4, 0.04, 0.95}, Material::kGlass);
      }
    }
    AddBox(mesh, At(0.5 * length, 0, deck), {0.04, 2.3, 1.1}, Material::kGlass);
    AddBox(mesh, At(-0.5 * length, 0, deck + 0.1), {0.04, 2.0, 0.8}, Material::kGlass);
  }
  for (const double side : {-1.0, 1.0}) {
    AddBox(mesh, At(0.5 * length + 0.15, side * 1.35, 1.9), {0.2, 0.2, 0.5}, Material::kDarkMetal);
    AddBox(mesh, At(-0.5 * length - 0.01, side * 1.05, 0.7), {0.03, 0.25, 0.5}, Material::kRetro);
  }
  AddBox(mesh, At(-1.5, 0, height), {2.2, 1.6, 0.25}, Material::kMetal);
  AddWheels(mesh, 3.3, -2.9, 1.25, 0.48);
  return mesh;
}

Mesh MakeTruck(Random& random) {
  Mesh mesh;
  const Material paint = Paint(random);
  AddBox(mesh, At(-0.9, 0, 1.05), {6.4, 2.5, 2.7}, random.Chance(0.5) ? Material::kPlaster : paint);
  AddBox(mesh, At(-0.2, 0, 0.6), {7.6, 0.9, 0.4}, Material::kDarkMetal);
  Taper cab;
  cab.bottom_m = {1.9, 2.3};
  cab.top_m = {1.55, 2.2};
  cab.top_shift_m = {-0.15, 0.0};
  cab.height_m = 2.35;
  AddTaper(mesh, At(3.35, 0, 0.55), cab, paint, paint);
  AddQuad(mesh, {4.2, -1.0, 1.8}, {4.2, 1.0, 1.8}, {4.09, 0.98, 2.7}, {4.09, -0.98, 2.7},
          Material::kGlass);
  AddBox(mesh, At(-4.1, 0, 0.55), {0.1, 2.3, 0.12}, Material::kRetro);
  AddWheels(mesh, 3.2, -2.4, 1.2, 0.48);
  AddWheels(mesh, -3.5, -2.4, 1.2, 0.48);
  return mesh;
}

}  // namespace

Mesh MakeVehicle(VehicleKind kind, Random& random) {
  switch (kind) {
    case VehicleKind::kCar:
      return MakeCar(random);
    case VehicleKind::kVan:
      return MakeVan(random);
    case VehicleKind::kBus:
      return MakeBus(random);
    case VehicleKind::kTruck:
      return MakeTruck(random);
  }
  return {};
}

Vector2 VehicleSize(VehicleKind kind) {
  switch (kind) {
    case VehicleKind::kCar:
      return {4.8, 1.9};
    case VehicleKind::kVan:
      return {5.2, 2.0};
    case VehicleKind::kBus:
      return {11.8, 2.6};
    case VehicleKind::kTruck:
      return {8.6, 2.6};
  }
  return {4.8, 1.9};
}

}  // namespace lio::sim
