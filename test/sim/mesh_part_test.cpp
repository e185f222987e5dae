// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/mesh_part.hpp"

#include <gtest/gtest.h>

namespace lio::sim {
namespace {

TEST(MeshPart, HasTheTrianglesThatMeetTheBoxAndTheirVerticesAlone) {
  Mesh mesh;
  AddQuad(mesh, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, Material::kBrick);
  AddQuad(mesh, {5, 0, 0}, {9, 0, 0}, {9, 1, 0}, {5, 1, 0}, Material::kGlass);
  AddQuad(mesh, {20, 0, 9}, {21, 0, 9}, {21, 1, 9}, {20, 1, 9}, Material::kBark);
  const Eigen::AlignedBox2f box(Eigen::Vector2f(8, -3), Eigen::Vector2f(22, 3));
  Mesh part;
  AddPartOf(mesh, box, part);
  ASSERT_EQ(part.triangles.size(), 4u);
  EXPECT_EQ(part.materials.front(), Material::kGlass);
  EXPECT_EQ(part.materials.back(), Material::kBark);
  EXPECT_LE(part.vertices_m.size(), 12u);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(part.vertices_m[part.triangles[i][k]], mesh.vertices_m[mesh.triangles[i + 2][k]]);
    }
  }
}

TEST(MeshPart, IsEmptyFarFromEverything) {
  Mesh mesh;
  AddQuad(mesh, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, Material::kBrick);
  const Eigen::AlignedBox2f box(Eigen::Vector2f(2, 2), Eigen::Vector2f(3, 3));
  Mesh part;
  AddPartOf(mesh, box, part);
  EXPECT_TRUE(part.triangles.empty());
}

}  // namespace
}  // namespace lio::sim
