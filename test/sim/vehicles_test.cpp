// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests MakeVehicle and VehicleSize.
#include <gtest/gtest.h>

#include "sim/mesh_checks.hpp"
#include "sim/props.hpp"

namespace lio::sim {
namespace {

using test::Extent;
using test::ExtentOf;
using test::MaterialsOf;

constexpr VehicleKind kKinds[] = {VehicleKind::kCar, VehicleKind::kVan, VehicleKind::kBus,
                                  VehicleKind::kTruck};

// Calls `check` with several vehicles of each kind.
template <class Check>
void ForSomeOfEachKind(const Check& check) {
  Random random(1, Purpose::kWorld);
  for (const VehicleKind kind : kKinds) {
    for (int i = 0; i < 8; ++i) {
      SCOPED_TRACE("kind " + std::to_string(static_cast<int>(kind)));
      check(kind, MakeVehicle(kind, random));
    }
  }
}

TEST(Vehicles, FitTheirFootprint) {
  ForSomeOfEachKind([](VehicleKind kind, const Mesh& mesh) {
    test::ExpectSound(mesh);
    const Extent extent = ExtentOf(mesh);
    const Vector2 size = VehicleSize(kind);
    EXPECT_LE(extent.Size().x(), size.x() + 0.7);
    EXPECT_GE(extent.Size().x(), size.x() - 1.0);
    EXPECT_LE(extent.Size().y(), size.y() + 0.6);  // mirrors
    EXPECT_GT(extent.high.z(), 1.3f);
    EXPECT_LT(extent.high.z(), 4.6f);
  });
}

TEST(Vehicles, StandOnTheirWheels) {
  ForSomeOfEachKind([](VehicleKind, const Mesh& mesh) {
    EXPECT_NEAR(ExtentOf(mesh).low.z(), 0.0, 0.02);
    const Extent wheels = ExtentOf(mesh, Material::kRubber);
    EXPECT_NEAR(wheels.low.z(), 0.0, 0.02);
    const Extent rest =
        ExtentOf(mesh, [](Material m) { return m != Material::kRubber && m != Material::kMetal; });
    EXPECT_GT(rest.low.z(), 0.15f) << "the body is above the ground";
  });
}

TEST(Vehicles, AreTheSameOnBothSides) {
  ForSomeOfEachKind([](VehicleKind, const Mesh& mesh) {
    const Extent extent = ExtentOf(mesh);
    EXPECT_NEAR(extent.low.y(), -extent.high.y(), 1e-5);
  });
}

// Reflectors at the rear send light back; x is forward.
TEST(Vehicles, ShowTheirReflectorsToWhoFollows) {
  ForSomeOfEachKind([](VehicleKind kind, const Mesh& mesh) {
    const Extent reflectors = ExtentOf(mesh, Material::kRetro);
    EXPECT_LT(reflectors.high.x(), -0.4 * VehicleSize(kind).x());
    EXPECT_TRUE(MaterialsOf(mesh).contains(Material::kGlass));
  });
}

TEST(Vehicles, CannotBeSeenThrough) {
  ForSomeOfEachKind([](VehicleKind kind, const Mesh& mesh) {
    const test::StillScene scene(mesh);
    const double half_m = 0.5 * VehicleSize(kind).x() - 0.8;
    for (double x = -half_m; x <= half_m; x += 0.1) {
      const Hit hit = scene.Cast({x, 10.0, 0.75}, -Vector3::UnitY());
      ASSERT_EQ(hit.object, Hit::kFixed) << x;
      EXPECT_LT(hit.range_m, 10.0) << x;  // on the near side
    }
  });
}

TEST(Vehicles, DifferAndAreTheSameForTheSameSeed) {
  Random one(3, Purpose::kTraffic), same(3, Purpose::kTraffic), other(4, Purpose::kTraffic);
  const Mesh car = MakeVehicle(VehicleKind::kCar, one);
  EXPECT_EQ(car.vertices_m, MakeVehicle(VehicleKind::kCar, same).vertices_m);
  EXPECT_NE(car.vertices_m, MakeVehicle(VehicleKind::kCar, other).vertices_m);
}

}  // namespace
}  // namespace lio::sim
