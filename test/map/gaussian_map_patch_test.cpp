// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests which cells of a GaussianMap count, as a plane or as a vertical structure.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <random>

#include "lio/map/gaussian_map.hpp"
#include "support/gaussian_cells.hpp"

namespace lio {
namespace {

// Returns points of a post of that radius through the middle of a voxel, leaning by `lean`.
std::vector<Vector3> PostPoints(const Vector3& centre, double radius_m, double lean_rad) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> height(-0.45, 0.45);
  std::uniform_real_distribution<double> turn(-3.14, 3.14);
  const Quaternion R = ExpSo3(Vector3(lean_rad, 0, 0));
  std::vector<Vector3> points;
  for (int i = 0; i < 60; ++i) {
    const double angle = turn(random);
    points.push_back(centre + R * Vector3(radius_m * std::cos(angle), radius_m * std::sin(angle),
                                          height(random)));
  }
  return points;
}

// Returns the points of a beam of this elevation, turning about the origin, in a crown around
// `centre`.
std::vector<Vector3> RingThroughCrown(const Vector3& centre, double elevation_rad) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> depth(-0.4, 0.4);
  const double azimuth = std::atan2(centre.y(), centre.x());
  const double range_m = centre.norm();
  std::vector<Vector3> points;
  for (int i = -6; i <= 6; ++i) {
    const double at = azimuth + i * 0.0035;
    const double r = range_m + depth(random);
    points.push_back(r * Vector3(std::cos(elevation_rad) * std::cos(at),
                                 std::cos(elevation_rad) * std::sin(at), std::sin(elevation_rad)));
  }
  return points;
}

// Returns points of a level plane through the middle of a voxel, with noise across it. Each point
// has one opposite it of the same height, so that the noise does not tilt the plane.
std::vector<Vector3> ThickPlane(const Vector3& centre, double noise_m) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> along(-0.45, 0.45);
  std::normal_distribution<double> across(0.0, noise_m);
  std::vector<Vector3> points;
  for (int i = 0; i < 100; ++i) {
    const Vector3 offset = {along(random), along(random), std::clamp(across(random), -0.49, 0.49)};
    points.push_back(centre + offset);
    points.push_back(centre + offset.cwiseProduct(Vector3(-1, -1, 1)));
  }
  return points;
}

Roughness RoughnessOfGround(double height_std_m, const Vector3& from_centre) {
  const Vector3 centre = CentreOf(10, 0, 0);
  GaussianMap map(TestOptions());
  map.SetRangeStd(0.02);
  map.Insert(ThickPlane(centre, height_std_m), centre + from_centre);
  return PatchAt(map, centre).roughness;
}

TEST(GaussianMapPatch, GroundIsRoughByWhatTheRangesNoiseDoesNotExplain) {
  const Vector3 from_afar(-10.0, 0.0, 1.5);
  const Roughness clods = RoughnessOfGround(0.03, from_afar);
  ASSERT_FALSE(clods.is_smooth());
  const float sine = 0.148f;  // the beams come in at it
  EXPECT_NEAR(clods.HeightAt(sine), 0.f, 0.001f);
  EXPECT_NEAR(clods.HeightAt(sine / 2.718f), 0.028f, 0.006f) << "its roughness";
  EXPECT_TRUE(RoughnessOfGround(0.007, from_afar).is_smooth()) << "asphalt";
  EXPECT_TRUE(RoughnessOfGround(0.02, {0.0, 0.0, 5.0}).is_smooth()) << "the ranges' noise";
}

// It tells the side that a surface was seen from at best, which is no beam.
TEST(GaussianMapPatch, ASavedMapDoesNotTellHowRoughItIs) {
  const Vector3 centre = CentreOf(10, 0, 0);
  const std::vector<Vector3> points = ThickPlane(centre, 0.03);
  const Eigen::Vector3f unknown = Eigen::Vector3f::Zero();
  const Eigen::Vector3f below = -Eigen::Vector3f::UnitZ();
  for (const Eigen::Vector3f& side : {unknown, below}) {
    GaussianMap map(TestOptions());
    map.InsertKept(points, std::vector<Eigen::Vector3f>(points.size(), side));
    ASSERT_GT(PatchAt(map, centre).thickness_var, 0.f);
    EXPECT_TRUE(PatchAt(map, centre).roughness.is_smooth());
  }
}

TEST(GaussianMapPatch, ARingThroughACrownIsNoPlane) {
  const Vector3 centre = CentreOf(24, 17, 2);
  const double elevation_rad = std::asin(centre.z() / centre.norm());
  const std::vector<Vector3> ring = RingThroughCrown(centre, elevation_rad);
  GaussianMap map(TestOptions());
  map.Insert(ring, Vector3::Zero());
  ASSERT_TRUE(Has(map, centre));
  EXPECT_EQ(PatchAt(map, centre).thickness_var, 0.f);

  // The same points, seen from above, are a piece of a surface.
  GaussianMap from_above(TestOptions());
  from_above.Insert(ring, centre + Vector3(5.0, 0.0, 5.0));
  EXPECT_GT(PatchAt(from_above, centre).thickness_var, 0.f);
}

TEST(GaussianMapPatch, PostsAreVerticalAndConstrainTwoHorizontalDirections) {
  GaussianMap map(TestOptions());
  const Vector3 centre = CentreOf(3, 4, 1);
  map.Insert(PostPoints(centre, 0.15, 0.1), Vector3::Zero());
  const SurfacePatch& patch = PatchAt(map, centre);
  ASSERT_GT(patch.thickness_var, 0.f);
  EXPECT_EQ(patch.kind, SurfacePatch::Kind::kVertical);
  EXPECT_NEAR(patch.normal.z(), 0.f, 1e-5f);
  EXPECT_NEAR(patch.tangent1_per_std.z(), 0.f, 1e-5f);
  EXPECT_NEAR(patch.normal.dot(patch.tangent1_per_std), 0.f, 1e-4f);
  EXPECT_NEAR(std::sqrt(patch.thickness_var), 0.1, 0.03);
}

TEST(GaussianMapPatch, VerticalGoesByTheGivenDirection) {
  GaussianMap map(TestOptions());
  map.SetUp(Vector3::UnitX());
  const Vector3 centre = CentreOf(0, 0, 0);
  map.Insert(PostPoints(centre, 0.1, 0.0), Vector3::Zero());
  EXPECT_EQ(PatchAt(map, centre).thickness_var, 0.f) << "lies on its side";
}

// Returns the standard deviation that a thing of this radius has in the map, over its points' own.
double ClumpStdRatio(double radius_m) {
  GaussianMap map(TestOptions());
  const Vector3 centre = CentreOf(3, 4, 1);
  map.Insert(PostPoints(centre, radius_m, 0.0), Vector3::Zero());
  const SurfacePatch& patch = PatchAt(map, centre);
  EXPECT_EQ(patch.kind, SurfacePatch::Kind::kVertical);
  return std::sqrt(static_cast<double>(patch.thickness_var)) / (radius_m / std::numbers::sqrt2);
}

// The wider a clump is, the more of a shift the cell's sides hide. The height's standard deviation
// is 0.26 m, so that the first one is a post.
TEST(GaussianMapPatch, ClumpsTellLessTheMoreOfTheCellTheyFill) {
  EXPECT_NEAR(ClumpStdRatio(0.15), 1.0, 0.15);  // the draw of 60 points
  EXPECT_NEAR(ClumpStdRatio(0.26), 1.0 / std::sqrt(1.0 - 12.0 * 0.26 * 0.26 / 2.0), 0.2);
  EXPECT_GT(ClumpStdRatio(0.34), 1.35);
}

TEST(GaussianMapPatch, AClumpOfFewPointsDoesNotCount) {
  const Vector3 centre = CentreOf(3, 4, 1);
  const std::vector<Vector3> points = PostPoints(centre, 0.3, 0.0);
  GaussianMap map(TestOptions());
  std::vector<Vector3> some;
  for (std::size_t i = 0; i < points.size(); i += points.size() / 12) some.push_back(points[i]);
  ASSERT_LT(static_cast<int>(some.size()), GaussianMapParameters::kMinClumpPoints);
  map.Insert(some, Vector3::Zero());
  EXPECT_EQ(PatchAt(map, centre).thickness_var, 0.f);
}

// A thing that walks fills the cell from one side; one that stands is seen where it was.
TEST(GaussianMapPatch, AThingThatMovesIsNoVerticalStructure) {
  for (const double step_m : {0.02, 0.2}) {
    GaussianMap map(TestOptions());
    const Vector3 centre = CentreOf(3, 4, 1);
    for (const double x_m : {0.0, step_m}) {
      map.Insert(PostPoints(centre + Vector3(x_m, 0.0, 0.0), 0.1, 0.0), Vector3::Zero());
    }
    EXPECT_EQ(PatchAt(map, centre).thickness_var > 0.f, step_m < 0.1) << step_m;
  }
}

// Returns points of a wall along x, of which the cell around `centre` has the last 15 cm.
std::vector<Vector3> WallPoints(const Vector3& centre) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> along(0.35, 1.45);
  std::uniform_real_distribution<double> height(-0.45, 0.45);
  std::normal_distribution<double> across(0.0, 0.01);
  std::vector<Vector3> points;
  for (int i = 0; i < 600; ++i) {
    points.push_back(centre + Vector3(along(random), across(random), height(random)));
  }
  return points;
}

TEST(GaussianMapPatch, AnEndOfAWallIsNoPost) {
  GaussianMap map(TestOptions());
  const Vector3 centre = CentreOf(3, 4, 1);
  map.Insert(WallPoints(centre), Vector3::Zero());
  ASSERT_EQ(PatchAt(map, centre + Vector3(1, 0, 0)).kind, SurfacePatch::Kind::kPlane);
  ASSERT_EQ(PatchAt(map, centre).kind, SurfacePatch::Kind::kVertical);
  EXPECT_NEAR(std::abs(PatchAt(map, centre).wall_normal().y()), 1.f, 0.01f);
}

TEST(GaussianMapPatch, APostBeforeAWallIsNoPartOfIt) {
  GaussianMap map(TestOptions());
  const Vector3 centre = CentreOf(3, 4, 1);
  const Vector3 post = centre - Vector3(0, 0.3, 0);
  map.Insert(PostPoints(post, 0.05, 0.0), Vector3::Zero());
  map.Insert(WallPoints(centre + Vector3(0.2, 0.1, 0)), Vector3::Zero());
  ASSERT_EQ(PatchAt(map, centre + Vector3(1, 0, 0)).kind, SurfacePatch::Kind::kPlane);
  ASSERT_EQ(PatchAt(map, post).kind, SurfacePatch::Kind::kVertical);
  EXPECT_TRUE(PatchAt(map, post).wall_normal().isZero(0.f));
}

TEST(GaussianMapPatch, APostThatStandsAloneIsNoPartOfAWall) {
  GaussianMap map(TestOptions());
  const Vector3 centre = CentreOf(3, 4, 1);
  map.Insert(PostPoints(centre, 0.1, 0.0), Vector3::Zero());
  std::vector<Vector3> ground = ThickPlane(CentreOf(4, 4, 1), 0.01);
  for (Vector3& point : ground) point.z() -= 0.3;
  map.Insert(ground, CentreOf(4, 4, 5));
  ASSERT_EQ(PatchAt(map, CentreOf(4, 4, 1)).kind, SurfacePatch::Kind::kPlane);
  ASSERT_EQ(PatchAt(map, centre).kind, SurfacePatch::Kind::kVertical);
  EXPECT_TRUE(PatchAt(map, centre).wall_normal().isZero(0.f))
      << "the ground beside it does not stand";
}

// Points that fill the cell's middle and are cut off by its sides tell little of a place in it.
TEST(GaussianMapPatch, BushesWiderThanTheCellDoNotCount) {
  GaussianMap map(TestOptions());
  const Vector3 centre = CentreOf(0, 0, 0);
  map.Insert(PostPoints(centre, 0.4, 0.0), Vector3::Zero());
  EXPECT_EQ(PatchAt(map, centre).thickness_var, 0.f);
}

bool IsPlane(double noise_m, double range_std_m) {
  GaussianMap map(TestOptions());
  map.SetRangeStd(range_std_m);
  map.Insert(ThickPlane(CentreOf(0, 0, 0), noise_m), CentreOf(0, 0, 9));
  const SurfacePatch& patch = PatchAt(map, CentreOf(0, 0, 0));
  return patch.thickness_var > 0.f && patch.kind == SurfacePatch::Kind::kPlane;
}

TEST(GaussianMapPatch, PlanesOfANoisyLidarAreThick) {
  EXPECT_FALSE(IsPlane(0.12, 0.0)) << "nothing is known of the noise";
  EXPECT_FALSE(IsPlane(0.12, 0.03));
  EXPECT_TRUE(IsPlane(0.12, 0.12));
  EXPECT_FALSE(IsPlane(0.25, 0.5)) << "a blob";
}

TEST(GaussianMapPatch, PatchHasTheMeanNormalAndThicknessOfItsPoints) {
  GaussianMap map(TestOptions());
  const Vector3 normal = Vector3(0.2, -0.3, 1.0).normalized();
  const std::vector<Vector3> points = PlanePoints(CentreOf(3, 4, 5), normal, 60);
  map.Insert(points, Vector3::Zero());
  Vector3 mean = Vector3::Zero();
  for (const Vector3& point : points) mean += point / 60.0;
  Matrix3 cov = Matrix3::Zero();
  for (const Vector3& point : points) cov += (point - mean) * (point - mean).transpose() / 59.0;
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(cov);

  const SurfacePatch& patch = PatchAt(map, CentreOf(3, 4, 5));
  EXPECT_LT((patch.mean.cast<double>() - (mean - CentreOf(3, 4, 5))).norm(), 1e-6);
  EXPECT_NEAR(std::abs(patch.normal.cast<double>().dot(normal)), 1.0, 1e-3);
  EXPECT_EQ(patch.num_points, 60.f);
  EXPECT_NEAR(patch.thickness_var, 0.03 * 0.03, 1e-6);  // the floor
  EXPECT_NEAR(patch.tangent1_per_std.norm(), 1 / std::sqrt(eigen.eigenvalues()[1]), 1e-3);
  EXPECT_NEAR(patch.tangent2_per_std.norm(), 1 / std::sqrt(eigen.eigenvalues()[2]), 1e-3);
  EXPECT_NEAR(patch.tangent1_per_std.dot(patch.normal), 0.f, 1e-4f);
}

TEST(GaussianMapPatch, ManyScansAndOneGiveTheSamePatch) {
  const std::vector<Vector3> points = PlanePoints(CentreOf(0, 0, 0), Vector3::UnitX(), 80);
  GaussianMap at_once(TestOptions());
  at_once.Insert(points, Vector3::Zero());
  GaussianMap in_parts(TestOptions());
  for (std::size_t i = 0; i < 80; i += 40) {
    in_parts.Insert(std::span(points).subspan(i, 40), Vector3::Zero());
  }
  const SurfacePatch& a = PatchAt(at_once, CentreOf(0, 0, 0));
  const SurfacePatch& b = PatchAt(in_parts, CentreOf(0, 0, 0));
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.thickness_var, b.thickness_var);
}

TEST(GaussianMapPatch, PrecisionDoesNotDependOnTheDistanceFromTheOrigin) {
  const Vector3 far(50000.0, -30000.0, 100.0);
  NdtOptions options = TestOptions();
  GaussianMap near_map(options);
  GaussianMap far_map(options);
  std::vector<Vector3> points = PlanePoints(CentreOf(0, 0, 0), Vector3::UnitY(), 50);
  near_map.Insert(points, Vector3::Zero());
  for (Vector3& point : points) point += far;
  far_map.Insert(points, far);
  const SurfacePatch& a = PatchAt(near_map, CentreOf(0, 0, 0));
  const SurfacePatch& b = PatchAt(far_map, CentreOf(0, 0, 0) + far);
  EXPECT_LT((a.mean - b.mean).norm(), 1e-6f);
  EXPECT_LT((a.normal - b.normal).norm(), 1e-5f);
}

TEST(GaussianMapPatch, FewPointsDoNotCount) {
  GaussianMap map(TestOptions());
  map.Insert(PlanePoints(CentreOf(0, 0, 0), Vector3::UnitZ(), 5), Vector3::Zero());
  EXPECT_EQ(PatchAt(map, CentreOf(0, 0, 0)).thickness_var, 0.f);
}

TEST(GaussianMapPatch, RingsOfAStandingVehicleDoNotCount) {
  GaussianMap map(TestOptions());
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0.0, 0.02);
  for (int scan = 0; scan < 50; ++scan) {  // one ring crosses the cell, scan after scan
    std::vector<Vector3> ring;
    for (double y = 0.05; y < 1.0; y += 0.1) ring.push_back({0.4 + noise(random), y, 0.3});
    map.Insert(ring, Vector3::Zero());
  }
  EXPECT_EQ(PatchAt(map, CentreOf(0, 0, 0)).thickness_var, 0.f);
  EXPECT_FALSE(map.IsFrozen(map.Find(CentreOf(0, 0, 0)).cell));
}

// Driving off, the rings move over the ground: the cell must become a plane then, however many
// points would freeze a plane.
TEST(GaussianMapPatch, CellOfRingsBecomesAPlaneWhenTheVehicleDrivesOff) {
  NdtOptions options = TestOptions();
  options.max_cell_points = 2000;
  GaussianMap map(options);
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0.0, 0.02);
  const auto insert_ring = [&](double x) {
    std::vector<Vector3> ring;
    for (double y = 0.05; y < 1.0; y += 0.1) {
      ring.push_back({x, y, 0.3 + noise(random)});
    }
    map.Insert(ring, Vector3::Zero());
  };
  for (int scan = 0; scan < 100; ++scan) insert_ring(0.4);
  for (int scan = 0; scan < 15; ++scan) insert_ring(0.05 + 0.06 * scan);
  const SurfacePatch& patch = PatchAt(map, CentreOf(0, 0, 0));
  EXPECT_GT(patch.thickness_var, 0.f);
  EXPECT_GT(std::abs(patch.normal.z()), 0.99f);
}

}  // namespace
}  // namespace lio
