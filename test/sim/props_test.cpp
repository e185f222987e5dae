// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests all props except vehicles, which have vehicles_test.cpp.
#include "sim/props.hpp"

#include <gtest/gtest.h>

#include "sim/mesh_checks.hpp"

namespace lio::sim {
namespace {

using test::ExpectSound;
using test::Extent;
using test::ExtentOf;
using test::MaterialsOf;

Random AnyRandom() {
  return Random(1, Purpose::kWorld);
}

TEST(Props, PeopleAreAsTallAsPeople) {
  Random random = AnyRandom();
  for (int i = 0; i < 20; ++i) {
    const Extent extent = ExtentOf(MakePerson(random));
    EXPECT_NEAR(extent.low.z(), 0.0, 0.05);
    EXPECT_GT(extent.high.z(), 1.6f);
    EXPECT_LT(extent.high.z(), 1.95f);
    EXPECT_LT(extent.Size().y(), 0.8f);
  }
}

// The leg turns about its origin, which must be its upper end.
TEST(Props, LegsHangFromTheHip) {
  const Extent leg = ExtentOf(MakeLeg());
  EXPECT_NEAR(leg.high.z(), 0.02, 0.1);
  EXPECT_NEAR(leg.low.z(), -kHipHeight_m, 1e-5);
  Random random = AnyRandom();
  EXPECT_NEAR(ExtentOf(MakeTorso(random)).low.z(), kHipHeight_m, 0.2);
}

TEST(Props, TreesHaveATrunkInTheGroundAndACrownAbove) {
  Random random = AnyRandom();
  for (const double height_m : {4.0, 8.0, 14.0}) {
    const Mesh tree = MakeTree(height_m, random);
    ExpectSound(tree);
    const Extent bark = ExtentOf(tree, Material::kBark);
    const Extent leaves = ExtentOf(tree, Material::kFoliage);
    EXPECT_LT(bark.low.z(), -0.2f);
    EXPECT_GT(leaves.low.z(), 0.1 * height_m) << "one can walk below it";
    EXPECT_NEAR(ExtentOf(tree).high.z(), height_m, 0.35 * height_m);
    EXPECT_GT(leaves.Size().x(), 0.3 * height_m);
  }
}

TEST(Props, BushesFillTheirSize) {
  Random random = AnyRandom();
  const Extent bush = ExtentOf(MakeBush({3.0, 1.0, 2.0}, random));
  // Leaves of up to 0.22 m extend beyond the ellipsoid.
  EXPECT_NEAR(bush.Size().x(), 3.0, 0.45);
  EXPECT_NEAR(bush.Size().y(), 1.0, 0.45);
  EXPECT_NEAR(bush.high.z(), 2.0, 0.25);
  EXPECT_GT(bush.low.z(), -0.3f);
}

TEST(Props, LampsReachOutToTheirFront) {
  const Mesh lamp = MakeStreetLamp(7.5, 1.6);
  ExpectSound(lamp);
  const Extent head = ExtentOf(lamp, Material::kDarkMetal);
  EXPECT_NEAR(0.5 * (head.low.x() + head.high.x()), 1.6, 1e-5);
  EXPECT_GT(head.low.z(), 7.0f);
  EXPECT_LT(ExtentOf(lamp).low.z(), 0.0f);
}

TEST(Props, SignsShowTheirFaceForward) {
  Random random = AnyRandom();
  const Mesh sign = MakeSign(2.5, random);
  const test::StillScene scene(sign);
  EXPECT_EQ(scene.Cast({5.0, 0.0, 2.3}, -Vector3::UnitX()).material, Material::kRetro);
  EXPECT_EQ(scene.Cast({-5.0, 0.0, 2.3}, Vector3::UnitX()).material, Material::kMetal)
      << "the post";
  EXPECT_NEAR(ExtentOf(sign).high.z(), 2.5, 0.05);
}

// The shelter is open to the front and has glass behind and beside the bench.
TEST(Props, SheltersAreOpenInFront) {
  const Mesh shelter = MakeBusShelter();
  const test::StillScene scene(shelter);
  const Hit rear = scene.Cast({5.0, 0.3, 1.5}, -Vector3::UnitX());
  EXPECT_EQ(rear.material, Material::kGlass);
  EXPECT_NEAR(rear.range_m, 5.7, 0.05);
  EXPECT_EQ(scene.Cast({0.0, 5.0, 1.5}, -Vector3::UnitY()).material, Material::kGlass);
  double height_m = 0.0;
  EXPECT_EQ(scene.Down({0, 0}, height_m).material, Material::kMetal);
  EXPECT_NEAR(height_m, 2.52, 1e-3);
}

TEST(Props, SmallThingsStandOnTheGround) {
  const std::vector<std::pair<Mesh, double>> cases = {
      {MakeBollard(), 0.95}, {MakeBin(), 0.95}, {MakeBench(), 0.85}};
  for (const auto& [mesh, height_m] : cases) {
    ExpectSound(mesh);
    EXPECT_NEAR(ExtentOf(mesh).high.z(), height_m, 1e-4);
    EXPECT_LE(ExtentOf(mesh).low.z(), 0.0f);
    EXPECT_GE(ExtentOf(mesh).low.z(), -0.2f);
  }
}

TEST(Props, OneSeedMakesOneThing) {
  Random a(5, Purpose::kWorld), b(5, Purpose::kWorld), c(6, Purpose::kWorld);
  const Mesh tree = MakeTree(8.0, a);
  EXPECT_EQ(tree.vertices_m, MakeTree(8.0, b).vertices_m);
  EXPECT_NE(tree.vertices_m, MakeTree(8.0, c).vertices_m);
}

}  // namespace
}  // namespace lio::sim
