// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/isosurface.hpp"

#include <gtest/gtest.h>

#include "sim/mesh_checks.hpp"

namespace lio::sim {
namespace {

TEST(Isosurface, MeshesASphereToItsSizeWithoutHoles) {
  constexpr double kRadius_m = 2.0;
  Mesh mesh;
  AddIsosurface(
      mesh, [](const Vector3& p_m) { return p_m.norm() - kRadius_m; }, Vector3::Constant(-3.0),
      Vector3::Constant(3.0), 0.1, Material::kEarth);
  ASSERT_GT(mesh.triangles.size(), 1000u);
  double area_m2 = 0.0;
  double volume_m3 = 0.0;
  for (const auto& triangle : mesh.triangles) {
    const Vector3f& a = mesh.vertices_m[triangle[0]];
    const Vector3f& b = mesh.vertices_m[triangle[1]];
    const Vector3f& c = mesh.vertices_m[triangle[2]];
    const Vector3f cross = (b - a).cross(c - a);
    area_m2 += 0.5 * double{cross.norm()};
    volume_m3 += std::abs(double{cross.dot(a)}) / 6.0;
    for (const Vector3f& vertex : {a, b, c}) EXPECT_NEAR(vertex.norm(), kRadius_m, 0.004);
  }
  // A closed surface that is seen from its middle fills all of the solid angle, once.
  EXPECT_NEAR(area_m2, 4.0 * M_PI * kRadius_m * kRadius_m, 0.2);
  EXPECT_NEAR(volume_m3, 4.0 / 3.0 * M_PI * std::pow(kRadius_m, 3), 0.15);
}

TEST(Isosurface, LeavesOutWhatIsFarFromTheSurface) {
  int num_asked = 0;
  Mesh mesh;
  AddIsosurface(
      mesh,
      [&](const Vector3& p_m) {
        ++num_asked;
        return p_m.z();
      },
      Vector3::Constant(-20.0), Vector3::Constant(20.0), 0.5, Material::kEarth);
  EXPECT_FALSE(mesh.triangles.empty());
  EXPECT_LT(num_asked, 81 * 81 * 81 / 3);
}

}  // namespace
}  // namespace lio::sim
