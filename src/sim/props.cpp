// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/props.hpp"

#include <cmath>

#include "lio/base/angle.hpp"
#include "sim/unturned_pose.hpp"

namespace lio::sim {
namespace {

// Adds a tapering bar of square section, such as a person's limb.
void AddLimb(Mesh& mesh, const Vector3& from, const Vector3& to, double from_radius,
             double to_radius, Material material) {
  AddBar(mesh, from, to, from_radius, to_radius, 6, material);
}

Vector3 RandomDirection(Random& random) {
  const double z = random.Uniform(-1.0, 1.0);
  const double angle = random.Uniform(0.0, kTurn_rad);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// Adds leaves: small triangles of random orientation, denser toward the surface of an ellipsoid.
void AddLeaves(Mesh& mesh, const Vector3& centre, const Vector3& radii, int num, double size,
               Random& random) {
  for (int i = 0; i < num; ++i) {
    const double depth = std::cbrt(random.Uniform(0.15, 1.0));
    const Vector3 at = centre + depth * radii.cwiseProduct(RandomDirection(random));
    const Vector3 u_direction = RandomDirection(random);
    const Vector3 u = size * random.Uniform(0.6, 1.4) * u_direction;
    const Vector3 v_direction = RandomDirection(random);
    const Vector3 v = size * random.Uniform(0.6, 1.4) * v_direction;
    AddTriangle(mesh, at - 0.5 * u, at + 0.5 * u, at + v, Material::kFoliage);
  }
}

}  // namespace

Mesh MakeTorso(Random& random) {
  Mesh mesh;
  const double scale = random.Uniform(0.92, 1.06);
  const Material clothes = random.Chance(0.5) ? Material::kCloth : Material::kCarPaintDark;
  Taper trunk;
  trunk.bottom_m = {0.22, 0.34};
  trunk.top_m = {0.24, 0.44};
  trunk.height_m = 0.58 * scale;
  AddTaper(mesh, At(0, 0, kHipHeight_m - 0.02), trunk, clothes, clothes);
  const double shoulder = kHipHeight_m + 0.54 * scale;
  for (const double side : {-1.0, 1.0}) {
    AddLimb(mesh, {0.0, 0.26 * side, shoulder}, {0.06, 0.31 * side, shoulder - 0.6}, 0.055, 0.04,
            clothes);
  }
  AddLimb(mesh, {0, 0, shoulder}, {0.01, 0, shoulder + 0.12}, 0.06, 0.06, Material::kSkin);
  AddLimb(mesh, {0.01, 0, shoulder + 0.1}, {0.01, 0, shoulder + 0.24}, 0.08, 0.11, Material::kSkin);
  AddLimb(mesh, {0.01, 0, shoulder + 0.24}, {0.0, 0, shoulder + 0.33}, 0.11, 0.05, Material::kWood);
  if (random.Chance(0.3)) {
    AddBox(mesh, At(-0.22, 0, shoulder - 0.45), {0.18, 0.3, 0.42}, Material::kDarkMetal);
  }
  return mesh;
}

Mesh MakeLeg() {
  Mesh mesh;
  AddLimb(mesh, {0, 0, 0.02}, {0.02, 0, -0.44}, 0.095, 0.06, Material::kCloth);
  AddLimb(mesh, {0.02, 0, -0.42}, {-0.02, 0, -0.8}, 0.06, 0.045, Material::kCloth);
  AddBox(mesh, At(0.05, 0, -kHipHeight_m), {0.27, 0.1, 0.08}, Material::kRubber);
  return mesh;
}

Mesh MakePerson(Random& random) {
  Mesh mesh = MakeTorso(random);
  for (const double side : {-1.0, 1.0}) {
    AddMesh(mesh, MakeLeg(), At(0.0, 0.1 * side, kHipHeight_m));
  }
  return mesh;
}

Mesh MakeTree(double height_m, Random& random) {
  Mesh mesh;
  const double trunk = height_m * random.Uniform(0.32, 0.42);
  const double radius = 0.025 * height_m * random.Uniform(0.8, 1.2);
  const double fork_y = 0.15 * random.Gaussian();
  const Vector3 fork(0.15 * random.Gaussian(), fork_y, trunk);
  AddBar(mesh, {0, 0, -0.3}, fork, 1.25 * radius, radius, 8, Material::kBark);
  const double crown = 0.5 * (height_m - trunk);
  const double width = crown * random.Uniform(0.75, 1.1);
  const int num_boughs = random.Integer(4, 6);
  for (int i = 0; i < num_boughs; ++i) {
    const double angle = kTurn_rad * (i + random.Uniform(0.0, 0.7)) / num_boughs;
    const Vector3 tip = fork + Vector3(0.7 * width * std::cos(angle), 0.7 * width * std::sin(angle),
                                       crown * random.Uniform(0.5, 1.2));
    AddBar(mesh, fork, tip, 0.6 * radius, 0.15 * radius, 5, Material::kBark);
    AddLeaves(mesh, tip, {0.65 * width, 0.65 * width, 0.55 * crown}, 90, 0.36, random);
  }
  const Vector3 centre = fork + Vector3(0, 0, 0.95 * crown);
  AddLeaves(mesh, centre, {width, width, crown}, 420, 0.42, random);
  return mesh;
}

Mesh MakeBush(const Vector3& size_m, Random& random) {
  Mesh mesh;
  const int num = 40 + static_cast<int>(60.0 * size_m.x() * size_m.y());
  for (int i = 0; i < num; ++i) {
    const double z_share = random.Uniform(0.05, 1.0);
    const double y_share = random.Uniform(-0.5, 0.5);
    const Vector3 at = size_m.cwiseProduct(Vector3(random.Uniform(-0.5, 0.5), y_share, z_share));
    const Vector3 u = 0.22 * RandomDirection(random);
    AddTriangle(mesh, at, at + u, at + 0.22 * RandomDirection(random), Material::kFoliage);
  }
  return mesh;
}

Mesh MakeStreetLamp(double height_m, double arm_m) {
  Mesh mesh;
  AddBar(mesh, {0, 0, -0.2}, {0, 0, 1.1}, 0.11, 0.10, 8, Material::kMetal);
  AddBar(mesh, {0, 0, 1.1}, {0, 0, height_m - 0.5}, 0.085, 0.055, 8, Material::kMetal);
  AddBar(mesh, {0, 0, height_m - 0.5}, {arm_m, 0, height_m}, 0.05, 0.04, 6, Material::kMetal);
  AddBox(mesh, At(arm_m, 0, height_m - 0.06), {0.7, 0.28, 0.12}, Material::kDarkMetal);
  return mesh;
}

Mesh MakeSign(double height_m, Random& random) {
  Mesh mesh;
  AddBar(mesh, {0, 0, -0.2}, {0, 0, height_m}, 0.038, 0.038, 8, Material::kMetal);
  const double width = random.Uniform(0.55, 0.8);
  const double tall = random.Chance(0.5) ? width : 0.45;
  AddBox(mesh, At(0.05, 0, height_m - tall), {0.02, width, tall}, Material::kRetro);
  return mesh;
}

Mesh MakeBollard() {
  Mesh mesh;
  AddBar(mesh, {0, 0, -0.1}, {0, 0, 0.95}, 0.07, 0.06, 8, Material::kDarkMetal);
  return mesh;
}

Mesh MakeBin() {
  Mesh mesh;
  AddBar(mesh, {0, 0, 0}, {0, 0, 0.95}, 0.24, 0.27, 10, Material::kDarkMetal);
  return mesh;
}

Mesh MakeBench() {
  Mesh mesh;
  for (const double side : {-0.7, 0.7}) {
    AddBox(mesh, At(0, side, 0), {0.42, 0.06, 0.42}, Material::kDarkMetal);
  }
  AddBox(mesh, At(0, 0, 0.42), {0.45, 1.7, 0.05}, Material::kWood);
  AddBox(mesh, At(-0.22, 0, 0.55), {0.05, 1.7, 0.3}, Material::kWood);
  return mesh;
}

Mesh MakeBusShelter() {
  Mesh mesh;
  for (const double side : {-1.9, 1.9}) {
    AddBox(mesh, At(-0.7, side, 0), {0.08, 0.08, 2.4}, Material::kDarkMetal);
    AddBox(mesh, At(0.7, side, 0), {0.08, 0.08, 2.4}, Material::kDarkMetal);
    AddBox(mesh, At(0.0, side, 0.2), {1.3, 0.02, 2.0}, Material::kGlass);
  }
  AddBox(mesh, At(-0.7, 0, 0.2), {0.02, 3.7, 2.0}, Material::kGlass);
  AddBox(mesh, At(0, 0, 2.4), {1.7, 4.2, 0.12}, Material::kMetal);
  AddBox(mesh, At(-0.4, 0, 0.45), {0.35, 2.6, 0.05}, Material::kWood);
  return mesh;
}

}  // namespace lio::sim
