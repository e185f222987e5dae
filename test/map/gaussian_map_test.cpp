// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/gaussian_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <list>
#include <random>
#include <stdexcept>
#include <unordered_map>

#include "support/gaussian_cells.hpp"
#include "support/property.hpp"

namespace lio {
namespace {

TEST(GaussianMap, RefusesOptionsOutOfRange) {
  const auto broken = [](auto change) {
    NdtOptions options = TestOptions();
    change(options);
    return options;
  };
  EXPECT_THROW(GaussianMap(broken([](auto& o) { o.voxel_m = 0; })), std::invalid_argument);
  EXPECT_THROW(GaussianMap(broken([](auto& o) { o.min_cell_points = 2; })), std::invalid_argument);
  EXPECT_THROW(GaussianMap(broken([](auto& o) { o.max_cells = 0; })), std::invalid_argument);
  EXPECT_THROW(GaussianMap(broken([](auto& o) { o.max_cell_points = o.min_cell_points; })),
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

TEST(GaussianMap, KnowsWhatTheLastScanBrought) {
  const Vector3 here = CentreOf(0, 0, 0);
  const Vector3 elsewhere = CentreOf(5, 0, 0);
  const Vector3 sensor(0.5, 0.5, 5.0);
  GaussianMap map(TestOptions());
  const auto share = [&](const Vector3& point) {
    return map.ShareOfLastScan(map.Find(point).cell);
  };
  map.Insert(PlanePoints(here, {0, 0, 1}, 20), sensor);
  EXPECT_EQ(share(here), 1.f) << "there was nothing before";
  map.Insert(PlanePoints(here, {0, 0, 1}, 10, 2), sensor);
  EXPECT_FLOAT_EQ(share(here), 1.f / 3.f);
  map.Insert(PlanePoints(elsewhere, {0, 0, 1}, 10, 3), sensor);
  EXPECT_EQ(share(here), 0.f);
  EXPECT_EQ(share(elsewhere), 1.f);
}

TEST(GaussianMap, NoScanBroughtWhatIsFullOrWasSavedBefore) {
  const Vector3 here = CentreOf(0, 0, 0);
  GaussianMap full(TestOptions());
  full.Insert(PlanePoints(here, {0, 0, 1}, 100), Vector3(0.5, 0.5, 5.0));
  full.Insert(PlanePoints(here, {0, 0, 1}, 10, 2), Vector3(0.5, 0.5, 5.0));
  EXPECT_EQ(full.ShareOfLastScan(full.Find(here).cell), 0.f);
  GaussianMap saved(TestOptions());
  const std::vector<Vector3> points = PlanePoints(here, {0, 0, 1}, 20);
  saved.InsertKept(points, std::vector<Eigen::Vector3f>(points.size(), Eigen::Vector3f::UnitZ()));
  EXPECT_EQ(saved.ShareOfLastScan(saved.Find(here).cell), 0.f);
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

void InsertKept(const std::vector<Vector3>& points, const Eigen::Vector3f& side, GaussianMap& map) {
  map.InsertKept(points, std::vector<Eigen::Vector3f>(points.size(), side));
}

// A slab is thinner than a cell: its upper side is the cell's surface.
TEST(GaussianMap, KeptCellsShowOneOfTwoSheets) {
  GaussianMap map(TestOptions());
  const Vector3 centre = CentreOf(3, 1, 0);
  std::vector<Vector3> points = PlanePoints(centre - Vector3(0, 0, 0.2), Vector3::UnitZ(), 60, 1);
  std::vector<Eigen::Vector3f> sides(60, {0, 0, -1});
  for (const Vector3& point : PlanePoints(centre + Vector3(0, 0, 0.2), Vector3::UnitZ(), 60, 2)) {
    points.push_back(point);
    sides.emplace_back(0, 0, 1);
  }
  map.InsertKept(points, sides);
  const SurfacePatch& patch = PatchAt(map, centre);
  EXPECT_GT(patch.thickness_var, 0.f);
  EXPECT_GT(std::abs(patch.normal.z()), 0.9f);
  EXPECT_NEAR(patch.mean.z(), 0.2f, 0.02f);
}

// Nobody knows from where the points of a saved map were seen, so that its walls have two sides.
TEST(GaussianMap, KeptCellsShowSurfacesOfTwoSides) {
  GaussianMap map(TestOptions());
  const Vector3 centre = CentreOf(3, 1, 0);
  InsertKept(PlanePoints(centre, Vector3::UnitX(), 60), {0, 0, 0}, map);
  EXPECT_GT(PatchAt(map, centre).thickness_var, 0.f);
  EXPECT_TRUE(PatchAt(map, centre).is_two_sided);
  const float before = PatchAt(map, centre).num_points;
  for (const double sensor_x : {-20.0, 20.0}) {
    map.Insert(PlanePoints(centre, Vector3::UnitX(), 10, 2), {sensor_x, 0, 0});
  }
  EXPECT_EQ(PatchAt(map, centre).num_points, before + 20.f) << "scans of both sides add to it";
  EXPECT_TRUE(PatchAt(map, centre).is_two_sided);
}

TEST(GaussianMap, KeptCellsStayAndDoNotCountForTheBound) {
  NdtOptions options = TestOptions();
  options.max_cells = 10;
  options.max_distance_m = 50.0;
  GaussianMap map(options);
  for (int i = 0; i < 30; ++i) {
    InsertKept(PlanePoints(CentreOf(i, 0, 0), {0, 0, 1}, 20), {0, 0, 1}, map);
  }
  const std::size_t num_kept = map.num_cells();
  EXPECT_GE(num_kept, 30u);
  for (int i = 0; i < 100; ++i) {
    const Vector3 far = CentreOf(1000 + 5 * i, 0, 0);
    map.Insert(PlanePoints(far, {0, 0, 1}, 20), far);
    EXPECT_LE(map.num_cells(), num_kept + 10);
  }
  for (int i = 0; i < 30; ++i) EXPECT_TRUE(Has(map, CentreOf(i, 0, 0))) << i;
}

TEST(GaussianMap, NormalsPointToTheSideThatWasSeen) {
  for (const double side : {-5.0, 5.0}) {
    GaussianMap map(TestOptions());
    map.Insert(PlanePoints(CentreOf(0, 0, 0), Vector3::UnitZ(), 50), Vector3(0.5, 0.5, side));
    EXPECT_GT(PatchAt(map, CentreOf(0, 0, 0)).normal.z() * side, 0.0);
  }
}

// A floor and the ceiling below it share a cell: the floor is no part of the ceiling.
TEST(GaussianMap, PointsSeenFromBehindASurfaceDoNotChangeIt) {
  GaussianMap map(TestOptions());
  map.Insert(PlanePoints({0.5, 0.5, 0.4}, Vector3::UnitZ(), 50), Vector3(0.5, 0.5, -3.0));
  const SurfacePatch before = PatchAt(map, CentreOf(0, 0, 0));
  map.Insert(PlanePoints({0.5, 0.5, 0.6}, Vector3::UnitZ(), 50, 2), Vector3(0.5, 0.5, 3.0));
  const SurfacePatch& after = PatchAt(map, CentreOf(0, 0, 0));
  EXPECT_EQ(after.mean, before.mean);
  EXPECT_EQ(after.num_points, before.num_points);
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

// Keeps the cells of a map with the same bounds in the simplest way.
class ReferenceMap {
 public:
  explicit ReferenceMap(std::size_t max_cells) : max_cells_(max_cells) {}

  void Insert(const std::vector<Vector3>& points) {
    ++scan_;
    for (const Vector3& point : points) {
      const VoxelKey key = KeyOf(point);
      const auto [found, is_new] = cells_.try_emplace(key);
      Cell& cell = found->second;
      ++cell.num_points;
      cell.scan = scan_;
      if (!is_new) continue;
      cell.listed = scan_;
      by_age_.push_back(key);
    }
    while (cells_.size() > max_cells_) {
      const VoxelKey key = by_age_.front();
      by_age_.pop_front();
      Cell& cell = cells_[key];
      if (cell.listed == cell.scan) {
        cells_.erase(key);
      } else {  // added to since its turn was set: it is put last
        cell.listed = cell.scan;
        by_age_.push_back(key);
      }
    }
  }
  std::size_t size() const { return cells_.size(); }
  // Returns the number of points in the voxel, 0 when it does not exist.
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
    int listed = 0;  // scan when the cell was last put in the order of age
  };
  std::size_t max_cells_;
  int scan_ = 0;
  std::unordered_map<VoxelKey, Cell> cells_;
  std::list<VoxelKey> by_age_;
};

// Random scans over a small block of voxels hold far more than fits: those that the reference keeps
// must remain, each under its own key, after any number of removals from the hash table.
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
