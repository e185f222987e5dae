// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "sim/mesh_checks.hpp"

namespace lio::sim {
namespace {

using test::AreaOf;
using test::ExpectSound;
using test::Extent;
using test::ExtentOf;

const Pose kOrigin;

TEST(Mesh, BoxHasItsSizeAndStandsOnItsOrigin) {
  Mesh mesh;
  AddBox(mesh, UprightPose({1.0, 2.0, 3.0}, 0.0), {2.0, 4.0, 6.0}, Material::kMetal);
  ExpectSound(mesh);
  const Extent extent = ExtentOf(mesh);
  EXPECT_TRUE(extent.low.isApprox(Vector3f(0.0f, 0.0f, 3.0f)));
  EXPECT_TRUE(extent.high.isApprox(Vector3f(2.0f, 4.0f, 9.0f)));
  EXPECT_NEAR(AreaOf(mesh), 2.0 * (8.0 + 12.0 + 24.0), 1e-4);  // all six faces
}

TEST(Mesh, EveryMaterialHasANameOfItsOwn) {
  std::set<std::string_view> names;
  for (int i = 0; i < kNumMaterials; ++i) {
    const MaterialTraits& traits = TraitsOf(static_cast<Material>(i));
    EXPECT_TRUE(names.insert(traits.name).second) << traits.name;
    EXPECT_GT(traits.reflectivity, 0.0) << traits.name;
    EXPECT_GE(traits.specular, 0.0) << traits.name;
    EXPECT_LE(traits.specular, 1.0) << traits.name;
  }
  EXPECT_EQ(TraitsOf(Material::kRetro).name, "retro");
  EXPECT_EQ(TraitsOf(Material::kCourt).name, "court");
}

TEST(Mesh, TriangleAndQuadHaveTheirAreas) {
  Mesh mesh;
  AddTriangle(mesh, {0, 0, 0}, {3, 0, 0}, {0, 4, 0}, Material::kGrass);
  EXPECT_NEAR(AreaOf(mesh), 6.0, 1e-5);
  AddQuad(mesh, {0, 0, 5}, {2, 0, 5}, {2, 3, 5}, {0, 3, 5}, Material::kEarth);
  EXPECT_NEAR(AreaOf(mesh), 12.0, 1e-5);
  EXPECT_EQ(mesh.materials,
            (std::vector<Material>{Material::kGrass, Material::kEarth, Material::kEarth}));
}

// The solid is a frustum: two rectangles and four trapezia of known slant.
TEST(Mesh, TaperNarrowsTowardItsTop) {
  Mesh mesh;
  Taper taper;
  taper.bottom_m = {4.0, 4.0};
  taper.top_m = {2.0, 2.0};
  taper.height_m = 1.0;
  AddTaper(mesh, kOrigin, taper, Material::kGlass, Material::kCarPaint);
  ExpectSound(mesh);
  EXPECT_NEAR(AreaOf(mesh), 16.0 + 4.0 + 4.0 * 0.5 * (4.0 + 2.0) * std::sqrt(2.0), 1e-4);
  const Extent top = ExtentOf(mesh, Material::kCarPaint);
  EXPECT_TRUE(top.low.isApprox(Vector3f(-1, -1, 1)));
  EXPECT_TRUE(top.high.isApprox(Vector3f(1, 1, 1)));
}

TEST(Mesh, TapersTopMayBeShifted) {
  Mesh mesh;
  Taper taper;
  taper.bottom_m = taper.top_m = {2.0, 2.0};
  taper.top_shift_m = {0.5, -0.25};
  AddTaper(mesh, kOrigin, taper, Material::kGlass, Material::kCarPaint);
  const Extent top = ExtentOf(mesh, Material::kCarPaint);
  EXPECT_TRUE(top.low.isApprox(Vector3f(-0.5f, -1.25f, 1)));
  EXPECT_TRUE(top.high.isApprox(Vector3f(1.5f, 0.75f, 1)));
}

// The expected values are circumference and area of a regular hexagon of radius 0.1 over 5 m,
// closed at one end.
TEST(Mesh, BarIsRoundAndClosedAtItsFarEnd) {
  Mesh mesh;
  const Vector3 from(1, 2, 3);
  const Vector3 to = from + 5.0 * Vector3(2, -1, 2).normalized();
  AddBar(mesh, from, to, 0.1, 0.1, 6, Material::kMetal);
  ExpectSound(mesh);
  EXPECT_NEAR(AreaOf(mesh), 6.0 * 0.1 * 5.0 + 6.0 * 0.5 * 0.01 * std::sin(std::numbers::pi / 3.0),
              1e-4);
  const Vector3 axis = (to - from).normalized();
  for (const Vector3f& vertex : mesh.vertices_m) {
    const Vector3 offset = vertex.cast<double>() - from;
    const double across = (offset - offset.dot(axis) * axis).norm();
    EXPECT_TRUE(std::abs(across - 0.1) < 1e-5 || across < 1e-5) << across;
    EXPECT_TRUE(std::abs(offset.dot(axis)) < 1e-5 || std::abs(offset.dot(axis) - 5.0) < 1e-5);
  }
}

TEST(Mesh, PrismStandsOnItsPolygon) {
  Mesh mesh;
  AddPrism(mesh, {{0, 0}, {3, 0}, {3, 4}}, 2.0, 10.0, Material::kBrick, Material::kConcrete);
  ExpectSound(mesh);
  EXPECT_NEAR(AreaOf(mesh), (3.0 + 4.0 + 5.0) * 10.0 + 6.0, 1e-3);
  EXPECT_EQ(ExtentOf(mesh).low.z(), 2.0f);
  EXPECT_EQ(ExtentOf(mesh, Material::kConcrete).low.z(), 12.0f);
}

TEST(Mesh, PartsAreAppendedWhereTheirPosePutsThem) {
  Mesh part;
  AddTriangle(part, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}, Material::kRetro);
  Mesh mesh;
  AddTriangle(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Material::kGrass);
  AddMesh(mesh, part, UprightPose({10, 20, 30}, 0.5 * std::numbers::pi));  // x goes to y
  ExpectSound(mesh);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{3, 4, 5}));
  EXPECT_EQ(mesh.materials[1], Material::kRetro);
  EXPECT_LT((mesh.vertices_m[3] - Vector3f(10, 21, 30)).norm(), 1e-5f);
  EXPECT_LT((mesh.vertices_m[4] - Vector3f(10, 22, 30)).norm(), 1e-5f);
  EXPECT_LT((mesh.vertices_m[5] - Vector3f(9, 21, 30)).norm(), 1e-5f);
}

TEST(Mesh, UprightPosesLookAlongTheirHeading) {
  const Pose pose = UprightPose({1, 2, 3}, std::numbers::pi / 6.0);
  EXPECT_LT((pose * Vector3::UnitX() - Vector3(1 + std::sqrt(0.75), 2.5, 3)).norm(), 1e-12);
  EXPECT_LT((pose.rotation * Vector3::UnitZ() - Vector3::UnitZ()).norm(), 1e-12);
}

}  // namespace
}  // namespace lio::sim
