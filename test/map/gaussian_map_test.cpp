// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/gaussian_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <list>
#include <random>
#include <stdexcept>
#include <unordered_map>

#include "support/property.hpp"

namespace lio {
namespace {

NdtOptions TestOptions() {
  NdtOptions options;
  options.voxel_m = 1.0;
  return options;
}

bool Has(const GaussianMap& map, const Vector3& point) {
  return map.Find(point).cell != GaussianMap::kNoCell;
}

const SurfacePatch& PatchAt(const GaussianMap& map, const Vector3& point) {
  return map.patch(map.Find(point).cell);
}

Vector3 CentreOf(int x, int y, int z) {
  return {x + 0.5, y + 0.5, z + 0.5};
}

// Points of a plane through `origin` inside the voxel there, 2 cm thick.
std::vector<Vector3> PlanePoints(const Vector3& origin, const Vector3& normal, int num,
                                 unsigned seed = 1) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> wide(-0.45, 0.45);
  std::normal_distribution<double> thick(0.0, 0.02);
  const Quaternion turn = Quaternion::FromTwoVectors(Vector3::UnitZ(), normal);
  std::vector<Vector3> points;
  while (static_cast<int>(points.size()) < num) {
    const Vector3 offset = turn * Vector3(wide(random), wide(random), thick(random));
    if (offset.cwiseAbs().maxCoeff() < 0.49) points.push_back(origin + offset);
  }
  return points;
}

// Points of a post of that radius through the middle of a voxel, leaning by `lean`.
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

// What a beam of this elevation, turning about the origin, leaves in a crown around `centre`.
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

TEST(GaussianMap, ARingThroughACrownIsNoPlane) {
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

TEST(GaussianMap, PostsAreUprightAndHoldInTwoLevelDirections) {
  GaussianMap map(TestOptions());
  const Vector3 centre = CentreOf(3, 4, 1);
  map.Insert(PostPoints(centre, 0.15, 0.1), Vector3::Zero());
  const SurfacePatch& patch = PatchAt(map, centre);
  ASSERT_GT(patch.thickness_var, 0.f);
  EXPECT_EQ(patch.kind, SurfacePatch::Kind::kUpright);
  EXPECT_NEAR(patch.normal.z(), 0.f, 1e-5f);
  EXPECT_NEAR(patch.tangent1_per_std.z(), 0.f, 1e-5f);
  EXPECT_NEAR(patch.normal.dot(patch.tangent1_per_std), 0.f, 1e-4f);
  EXPECT_NEAR(std::sqrt(patch.thickness_var), 0.1, 0.03);
}

TEST(GaussianMap, UprightGoesByTheGivenUp) {
  GaussianMap map(TestOptions());
  map.SetUp(Vector3::UnitX());
  const Vector3 centre = CentreOf(0, 0, 0);
  map.Insert(PostPoints(centre, 0.1, 0.0), Vector3::Zero());
  EXPECT_EQ(PatchAt(map, centre).thickness_var, 0.f) << "lies on its side";
}

// What fills the cell says nothing of where it is.
TEST(GaussianMap, BushesWiderThanTheCellDoNotCount) {
  GaussianMap map(TestOptions());
  const Vector3 centre = CentreOf(0, 0, 0);
  map.Insert(PostPoints(centre, 0.4, 0.0), Vector3::Zero());
  EXPECT_EQ(PatchAt(map, centre).thickness_var, 0.f);
}

TEST(GaussianMap, RefusesOptionsOutOfRange) {
  const auto broken = [](auto change) {
    NdtOptions options = TestOptions();
    change(options);
    return options;
  };
  EXPECT_THROW(GaussianMap(broken([](auto& o) { o.voxel_m = 0; })), std::invalid_argument);
  EXPECT_THROW(GaussianMap(broken([](auto& o) { o.min_cell_points = 2; })), std::invalid_argument);
  EXPECT_THROW(GaussianMap(broken([](auto& o) { o.max_cells = 0; })), std::invalid_argument);
  EXPECT_THROW(GaussianMap(broken([](auto& o) { o.max_cell_points = o.min_cell_points - 1; })),
               std::invalid_argument);
}

TEST(GaussianMap, EmptyMapHasNothing) {
  const GaussianMap map(TestOptions());
  EXPECT_EQ(map.num_cells(), 0u);
  EXPECT_FALSE(Has(map, Vector3::Zero()));
}

TEST(GaussianMap, FindingAllIsFindingEach) {
  GaussianMap map(TestOptions());
  std::vector<Vector3> points;
  for (int i = 0; i < 100; ++i) points.push_back({0.37 * i, -0.21 * i, 0.05 * i});
  map.Insert(points, Vector3::Zero());
  points.push_back({1e30, 0.0, 0.0});
  points.push_back({0.0, std::numeric_limits<double>::quiet_NaN(), 0.0});
  points.push_back({500.0, 0.0, 0.0});
  std::vector<GaussianMap::Hit> hits(points.size());
  map.FindAll(points, hits);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(hits[i].cell, map.Find(points[i]).cell) << i;
    EXPECT_EQ(hits[i].local, map.Find(points[i]).local) << i;
    EXPECT_EQ(hits[i].cell != GaussianMap::kNoCell, i < 100) << i;
  }
}

TEST(GaussianMap, MoreThreadsMakeTheSameMap) {
  GaussianMap alone(TestOptions());
  GaussianMap together(TestOptions());
  const std::vector<Vector3> points = PlanePoints({0, 0, 0}, {0.1, 0.2, 1.0}, 3000);
  for (const double shift : {0.0, 3.0, 6.0}) {
    std::vector<Vector3> moved = points;
    for (Vector3& point : moved) point += shift * (point + Vector3::UnitX());
    alone.Insert(moved, Vector3::Zero());
    together.Insert(moved, Vector3::Zero(), Workers(3));
  }
  ASSERT_EQ(alone.num_cells(), together.num_cells());
  for (std::size_t i = 0; i < alone.cell_capacity(); ++i) {
    const auto cell = static_cast<std::int32_t>(i);
    EXPECT_EQ(alone.patch(cell).mean, together.patch(cell).mean);
    EXPECT_EQ(alone.patch(cell).normal, together.patch(cell).normal);
    EXPECT_EQ(alone.patch(cell).thickness_var, together.patch(cell).thickness_var);
  }
}

TEST(GaussianMap, PointsAreFoundInTheirVoxelAlone) {
  GaussianMap map(TestOptions());
  map.Insert(std::vector<Vector3>{{0.2, -0.3, 0.9}}, Vector3::Zero());
  EXPECT_TRUE(Has(map, {0.9, -0.9, 0.1}));
  EXPECT_FALSE(Has(map, {-0.1, -0.3, 0.9}));
  EXPECT_FALSE(Has(map, {0.2, 0.1, 0.9}));
  EXPECT_FALSE(Has(map, {0.2, -0.3, 1.0}));
  const GaussianMap::Hit hit = map.Find({0.75, -0.25, 0.5});
  EXPECT_LT((hit.local - Eigen::Vector3f(0.25f, 0.25f, 0.0f)).norm(), 1e-6f);
}

TEST(GaussianMap, PatchHasTheMeanNormalAndThicknessOfItsPoints) {
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

TEST(GaussianMap, ManyScansAndOneGiveTheSamePatch) {
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

TEST(GaussianMap, PrecisionDoesNotDependOnTheDistanceFromTheOrigin) {
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

TEST(GaussianMap, FewPointsDoNotCount) {
  GaussianMap map(TestOptions());
  map.Insert(PlanePoints(CentreOf(0, 0, 0), Vector3::UnitZ(), 5), Vector3::Zero());
  EXPECT_EQ(PatchAt(map, CentreOf(0, 0, 0)).thickness_var, 0.f);
}

TEST(GaussianMap, RingsOfAStandingVehicleDoNotCount) {
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

// Driving off, the rings move over the ground: the cell must become a plane then.
TEST(GaussianMap, CellOfRingsBecomesAPlaneWhenTheVehicleDrivesOff) {
  GaussianMap map(TestOptions());
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

TEST(GaussianMap, FullCellIsFrozen) {
  GaussianMap map(TestOptions());
  map.Insert(PlanePoints(CentreOf(0, 0, 0), Vector3::UnitZ(), 120, 1), Vector3::Zero());
  const std::int32_t cell = map.Find(CentreOf(0, 0, 0)).cell;
  EXPECT_TRUE(map.IsFrozen(cell));
  const SurfacePatch before = map.patch(cell);
  map.Insert(PlanePoints(CentreOf(0, 0, 0), Vector3::UnitX(), 120, 2), Vector3::Zero());
  EXPECT_EQ(map.patch(cell).mean, before.mean);
  EXPECT_EQ(map.patch(cell).normal, before.normal);
}

TEST(GaussianMap, NonFiniteAndFarAwayPointsAreLeftOut) {
  GaussianMap map(TestOptions());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  map.Insert(std::vector<Vector3>{{nan, 0, 0},
                                  {1, nan, 2},
                                  {1, 2, nan},
                                  {nan, nan, nan},
                                  {inf, 0, 0},
                                  {0, -inf, 0},
                                  {3e6, 0, 0},
                                  {0, 1e300, 0}},
             Vector3::Zero());
  EXPECT_EQ(map.num_cells(), 0u);
}

TEST(GaussianMap, NothingIsFoundWhereNoVoxelCanBe) {
  GaussianMap map(TestOptions());
  map.Insert(std::vector<Vector3>{{0.5, 0.5, 0.5}}, Vector3::Zero());
  const double wrap = 2.0 * kVoxelCoordinateLimit;  // coordinates repeat after this many voxels
  EXPECT_FALSE(Has(map, {0.5 + wrap, 0.5, 0.5}));
  EXPECT_FALSE(Has(map, {0.5, 0.5, 0.5 - wrap}));
  EXPECT_FALSE(Has(map, {1e300, 0, 0}));
  EXPECT_FALSE(Has(map, {std::numeric_limits<double>::quiet_NaN(), 0.5, 0.5}));
}

TEST(GaussianMap, CellsBeyondTheDistanceAreDroppedWithinSomeScans) {
  NdtOptions options = TestOptions();
  options.max_distance_m = 50.0;
  GaussianMap map(options);
  std::vector<Vector3> points;
  for (int x = 0; x < 100; ++x) points.push_back(CentreOf(x, 0, 0));
  map.Insert(points, Vector3::Zero());
  for (int scan = 0; scan < 80; ++scan) map.Insert({}, Vector3::Zero());
  for (int x = 0; x < 100; ++x) EXPECT_EQ(Has(map, CentreOf(x, 0, 0)), x + 0.5 <= 50.0) << x;
}

TEST(GaussianMap, MemoryStaysBoundedOnALongWay) {
  NdtOptions options = TestOptions();
  options.max_cells = 2000;
  GaussianMap map(options);
  std::size_t most = 0;
  for (int scan = 0; scan < 500; ++scan) {
    std::vector<Vector3> points;
    for (int y = -20; y < 20; ++y) points.push_back(CentreOf(scan, y, 0));
    map.Insert(points, CentreOf(scan, 0, 0));
    EXPECT_LE(map.num_cells(), 2000u);
    if (scan == 100) most = map.memory_bytes();
  }
  EXPECT_EQ(map.memory_bytes(), most);
}

// The cells of a map with the same bounds, by the plainest means.
class ReferenceMap {
 public:
  explicit ReferenceMap(std::size_t max_cells) : max_cells_(max_cells) {}

  void Insert(const std::vector<Vector3>& points) {
    ++scan_;
    for (const Vector3& point : points) {
      const VoxelKey key = KeyOf(point);
      const auto found = cells_.find(key);
      if (found != cells_.end()) {
        ++found->second.num_points;
        if (found->second.scan == scan_) continue;
        by_time_.erase(found->second.at);
      } else {
        cells_[key].num_points = 1;
      }
      cells_[key].scan = scan_;
      cells_[key].at = by_time_.insert(by_time_.end(), key);
    }
    while (cells_.size() > max_cells_) {
      cells_.erase(by_time_.front());
      by_time_.pop_front();
    }
  }
  std::size_t size() const { return cells_.size(); }
  // Points in the voxel, 0 when it is not there.
  int Count(const Vector3& point) const {
    const auto found = cells_.find(KeyOf(point));
    return found == cells_.end() ? 0 : found->second.num_points;
  }

 private:
  static VoxelKey KeyOf(const Vector3& point) {
    const auto floor = [](double x) { return static_cast<std::int32_t>(std::floor(x)); };
    return PackVoxel(floor(point.x()), floor(point.y()), floor(point.z()));
  }
  struct Cell {
    int num_points = 0;
    int scan = 0;
    std::list<VoxelKey>::iterator at;
  };
  std::size_t max_cells_;
  int scan_ = 0;
  std::unordered_map<VoxelKey, Cell> cells_;
  std::list<VoxelKey> by_time_;  // least recently added to first
};

// Random scans over a small block of voxels, far more than fit: what is left must be exactly what
// was added to last, found under its own key, after any number of removals from the hash table.
TEST(GaussianMap, EvictionAgreesWithAReferenceMap) {
  test::CheckProperty([] {
    const auto max_cells = *rc::gen::inRange(1, 400);
    const auto seed = *rc::gen::arbitrary<unsigned>();
    NdtOptions options = TestOptions();
    options.max_cells = max_cells;
    GaussianMap map(options);
    ReferenceMap reference(static_cast<std::size_t>(max_cells));
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> coordinate(-8, 7);
    for (int scan = 0; scan < 60; ++scan) {
      std::vector<Vector3> points;
      const int num_points = std::uniform_int_distribution<int>(0, 80)(random);
      for (int i = 0; i < num_points; ++i) {
        points.push_back(CentreOf(coordinate(random), coordinate(random), coordinate(random) / 4));
      }
      map.Insert(points, Vector3::Zero());
      reference.Insert(points);
      RC_ASSERT(map.num_cells() == reference.size());
    }
    for (int x = -8; x < 8; ++x) {
      for (int y = -8; y < 8; ++y) {
        for (int z = -2; z < 2; ++z) {
          const int expected = reference.Count(CentreOf(x, y, z));
          RC_ASSERT(Has(map, CentreOf(x, y, z)) == (expected > 0));
          if (expected == 0) continue;
          RC_ASSERT(static_cast<int>(PatchAt(map, CentreOf(x, y, z)).num_points) ==
                    std::min(expected, options.max_cell_points));
        }
      }
    }
  });
}

}  // namespace
}  // namespace lio
