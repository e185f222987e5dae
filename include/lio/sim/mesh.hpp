// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds triangle meshes with a material for each triangle, and makes the solids of which things
// consist. Lengths are in metres; each mesh has its own frame with z up.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/sim/path.hpp"

namespace lio::sim {

using Vector3f = Eigen::Vector3f;

enum class Material : std::uint8_t {
  kAsphalt,
  kPaving,
  kConcrete,
  kPlaster,
  kPlasterWarm,
  kBrick,
  kGlass,
  kMetal,
  kDarkMetal,
  kCarPaint,
  kCarPaintDark,
  kCarPaintRed,
  kCarPaintBlue,
  kCarPaintGrey,
  kRubber,
  kFoliage,
  kBark,
  kGrass,
  kEarth,
  kMarking,
  kRetro,
  kCloth,
  kSkin,
  kWood,
  kRoofTile,
  kCourt,
  kSoil,   // tilled
  kHedge,  // clipped
};
inline constexpr int kNumMaterials = 28;

struct MaterialTraits {
  std::string_view name;
  double reflectivity = 0.3;      // a matt surface's at 905 nm, 0..1; above 1: retroreflective
  double specular = 0.0;          // share of the light that is reflected as by a mirror
  std::array<float, 3> colour{};  // used in pictures, 0..1
  double relief_m = 0.0;          // tufts and clods rise and fall by up to this (relief.hpp)
};
[[nodiscard]] const MaterialTraits& TraitsOf(Material material);

struct Mesh {
  std::vector<Vector3f> vertices_m;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Material> materials;  // one per triangle
};

// The functions below append to `mesh`.
void AddMesh(Mesh& mesh, const Mesh& part, const Pose& T_mesh_part);
void AddTriangle(Mesh& mesh, const Vector3& a, const Vector3& b, const Vector3& c,
                 Material material);
// The corners are given in order around the quad, which need not be plane.
void AddQuad(Mesh& mesh, const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d,
             Material material);
// Adds a box of the given size; the centre of its bottom is at the pose's origin.
void AddBox(Mesh& mesh, const Pose& T_mesh_box, const Vector3& size_m, Material material);
// Describes a tapering box: it has bottom and top rectangles around the z axis, and its sides and
// top have materials of their own.
struct Taper {
  Vector2 bottom_m;
  Vector2 top_m;
  Vector2 top_shift_m = Vector2::Zero();
  double height_m = 1.0;
};
void AddTaper(Mesh& mesh, const Pose& T_mesh_taper, const Taper& taper, Material sides,
              Material top);
// Adds a round bar from one point to another, closed at the far end.
void AddBar(Mesh& mesh, const Vector3& from_m, const Vector3& to_m, double from_radius_m,
            double to_radius_m, int num_sides, Material material);
// Extrudes a polygon that is star-shaped about its first corner, from z to z + height.
void AddPrism(Mesh& mesh, const std::vector<Vector2>& polygon_m, double z_m, double height_m,
              Material sides, Material top);

// Returns a pose whose x axis points to a heading and whose z axis points up.
[[nodiscard]] Pose UprightPose(const Vector3& position_m, double heading_rad);

}  // namespace lio::sim
