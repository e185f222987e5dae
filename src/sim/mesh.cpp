// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/mesh.hpp"

#include <cmath>
#include <numbers>

namespace lio::sim {
namespace {

// The reflectivities are usual values in the near infrared, as in application notes of lidar
// makers.
constexpr std::array<MaterialTraits, kNumMaterials> kTraits = {{
    {"asphalt", 0.17, 0.0, {0.30f, 0.30f, 0.32f}},
    {"paving", 0.32, 0.0, {0.62f, 0.60f, 0.57f}},
    {"concrete", 0.35, 0.0, {0.66f, 0.65f, 0.62f}},
    {"plaster", 0.60, 0.0, {0.86f, 0.84f, 0.78f}},
    {"plaster_warm", 0.50, 0.0, {0.84f, 0.69f, 0.52f}},
    {"brick", 0.38, 0.0, {0.66f, 0.38f, 0.30f}},
    {"glass", 0.08, 0.85, {0.36f, 0.48f, 0.56f}},
    {"metal", 0.45, 0.3, {0.70f, 0.72f, 0.74f}},
    {"dark_metal", 0.20, 0.2, {0.28f, 0.29f, 0.31f}},
    {"car_paint", 0.45, 0.35, {0.80f, 0.80f, 0.82f}},
    {"car_paint_dark", 0.10, 0.5, {0.16f, 0.16f, 0.18f}},
    {"car_paint_red", 0.40, 0.35, {0.66f, 0.16f, 0.14f}},
    {"car_paint_blue", 0.25, 0.35, {0.20f, 0.32f, 0.56f}},
    {"car_paint_grey", 0.35, 0.4, {0.50f, 0.52f, 0.54f}},
    {"rubber", 0.05, 0.0, {0.12f, 0.12f, 0.12f}},
    {"foliage", 0.45, 0.0, {0.30f, 0.50f, 0.22f}},
    {"bark", 0.30, 0.0, {0.40f, 0.31f, 0.22f}},
    {"grass", 0.40, 0.0, {0.46f, 0.60f, 0.32f}, 0.04},
    {"earth", 0.25, 0.0, {0.56f, 0.48f, 0.36f}},
    {"marking", 0.70, 0.0, {0.95f, 0.95f, 0.92f}},
    {"retro", 3.00, 0.0, {0.95f, 0.80f, 0.20f}},
    {"cloth", 0.40, 0.0, {0.25f, 0.35f, 0.62f}},
    {"skin", 0.45, 0.0, {0.80f, 0.62f, 0.52f}},
    {"wood", 0.45, 0.0, {0.62f, 0.48f, 0.32f}},
    {"roof_tile", 0.30, 0.0, {0.62f, 0.32f, 0.24f}},
    {"court", 0.50, 0.1, {0.76f, 0.56f, 0.34f}},
    {"soil", 0.25, 0.0, {0.52f, 0.42f, 0.30f}, 0.07},
    {"hedge", 0.45, 0.0, {0.26f, 0.44f, 0.20f}, 0.05},
}};

std::uint32_t AddVertex(Mesh& mesh, const Vector3& p) {
  mesh.vertices_m.push_back(p.cast<float>());
  return static_cast<std::uint32_t>(mesh.vertices_m.size() - 1);
}

void AddFace(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, Material material) {
  mesh.triangles.push_back({a, b, c});
  mesh.materials.push_back(material);
}

}  // namespace

const MaterialTraits& TraitsOf(Material material) {
  return kTraits[static_cast<std::size_t>(material)];
}

void AddMesh(Mesh& mesh, const Mesh& part, const Pose& T_mesh_part) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (const Vector3f& vertex : part.vertices_m)
    AddVertex(mesh, T_mesh_part * vertex.cast<double>());
  for (const auto& t : part.triangles) {
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  mesh.materials.insert(mesh.materials.end(), part.materials.begin(), part.materials.end());
}

void AddTriangle(Mesh& mesh, const Vector3& a, const Vector3& b, const Vector3& c,
                 Material material) {
  const std::uint32_t ia = AddVertex(mesh, a);
  const std::uint32_t ib = AddVertex(mesh, b);
  AddFace(mesh, ia, ib, AddVertex(mesh, c), material);
}

void AddQuad(Mesh& mesh, const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d,
             Material material) {
  const std::uint32_t ia = AddVertex(mesh, a);
  const std::uint32_t ib = AddVertex(mesh, b);
  const std::uint32_t ic = AddVertex(mesh, c);
  const std::uint32_t id = AddVertex(mesh, d);
  AddFace(mesh, ia, ib, ic, material);
  AddFace(mesh, ia, ic, id, material);
}

void AddBox(Mesh& mesh, const Pose& T_mesh_box, const Vector3& size_m, Material material) {
  Taper box;
  box.bottom_m = size_m.head<2>();
  box.top_m = size_m.head<2>();
  box.height_m = size_m.z();
  AddTaper(mesh, T_mesh_box, box, material, material);
}

void AddTaper(Mesh& mesh, const Pose& T_mesh_taper, const Taper& taper, Material sides,
              Material top) {
  std::array<Vector3, 4> low;
  std::array<Vector3, 4> high;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2 sign((i == 0 || i == 3) ? -0.5 : 0.5, i < 2 ? -0.5 : 0.5);
    const Vector2 l = sign.cwiseProduct(taper.bottom_m);
    const Vector2 h = sign.cwiseProduct(taper.top_m) + taper.top_shift_m;
    low[i] = T_mesh_taper * Vector3(l.x(), l.y(), 0.0);
    high[i] = T_mesh_taper * Vector3(h.x(), h.y(), taper.height_m);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    AddQuad(mesh, low[i], low[j], high[j], high[i], sides);
  }
  AddQuad(mesh, high[0], high[1], high[2], high[3], top);
  AddQuad(mesh, low[3], low[2], low[1], low[0], sides);
}

void AddBar(Mesh& mesh, const Vector3& from_m, const Vector3& to_m, double from_radius_m,
            double to_radius_m, int num_sides, Material material) {
  const Vector3 axis = (to_m - from_m).normalized();
  const Vector3 u = axis.unitOrthogonal();
  const Vector3 v = axis.cross(u);
  const auto at = [&](int i, bool far) -> Vector3 {
    const double angle = 2.0 * std::numbers::pi * i / num_sides;
    const Vector3 out = std::cos(angle) * u + std::sin(angle) * v;
    return far ? Vector3(to_m + to_radius_m * out) : Vector3(from_m + from_radius_m * out);
  };
  for (int i = 0; i < num_sides; ++i) {
    AddQuad(mesh, at(i, false), at(i + 1, false), at(i + 1, true), at(i, true), material);
    AddTriangle(mesh, to_m, at(i, true), at(i + 1, true), material);
  }
}

void AddPrism(Mesh& mesh, const std::vector<Vector2>& polygon_m, double z_m, double height_m,
              Material sides, Material top) {
  const auto at = [&](std::size_t i, double z) {
    const Vector2& p = polygon_m[i % polygon_m.size()];
    return Vector3(p.x(), p.y(), z);
  };
  for (std::size_t i = 0; i < polygon_m.size(); ++i) {
    AddQuad(mesh, at(i, z_m), at(i + 1, z_m), at(i + 1, z_m + height_m), at(i, z_m + height_m),
            sides);
  }
  for (std::size_t i = 1; i + 1 < polygon_m.size(); ++i) {
    AddTriangle(mesh, at(0, z_m + height_m), at(i, z_m + height_m), at(i + 1, z_m + height_m), top);
  }
}

Pose UprightPose(const Vector3& position_m, double heading_rad) {
  return {Quaternion(Eigen::AngleAxisd(heading_rad, Vector3::UnitZ())), position_m};
}

}  // namespace lio::sim
