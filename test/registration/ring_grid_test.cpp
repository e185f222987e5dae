// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/ring_grid.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace lio {
namespace {

using Apart = RingGrid::Apart;

RingGrid Make(const std::vector<std::pair<Eigen::Vector3f, int>>& points) {
  RingGrid grid;
  for (const auto& [point, ring] : points) grid.Add(point, static_cast<std::uint16_t>(ring));
  return grid;
}

TEST(RingGrid, AnEmptyOneFindsNothing) {
  const RingGrid::Found found = RingGrid().Search({0, 0, 0}, 5.f, {});
  EXPECT_EQ(found.nearest, -1);
  EXPECT_EQ(found.same_ring, -1);
  EXPECT_EQ(found.other_ring, -1);
  EXPECT_EQ(found.part, -1);
}

TEST(RingGrid, FindsTheNearestOfItsRingAndOfAnother) {
  const RingGrid grid = Make({{{0, 0, 0}, 10},
                              {{0.3f, 0, 0}, 10},
                              {{0.9f, 0, 0}, 10},
                              {{0, 0, 0.5f}, 11},
                              {{0, 0, 1}, 12}});
  const RingGrid::Found found = grid.Search({-0.1f, 0, 0}, 2.f, {});
  EXPECT_EQ(found.nearest, 0);
  EXPECT_EQ(found.same_ring, 1);
  EXPECT_EQ(found.other_ring, 3);
}

TEST(RingGrid, TheOthersAreAsFarApartAsAskedFor) {
  const RingGrid grid = Make({{{0, 0, 0}, 10},
                              {{0.3f, 0, 0}, 10},
                              {{0.9f, 0, 0}, 10},
                              {{0, 0, 0.5f}, 11},
                              {{0, 0, 1}, 12}});
  const RingGrid::Found found = grid.Search({-0.1f, 0, 0}, 2.f, Apart{0.5f, 0.8f});
  EXPECT_EQ(found.nearest, 0);
  EXPECT_EQ(found.same_ring, 2);
  EXPECT_EQ(found.other_ring, 4);
}

TEST(RingGrid, RingsMoreThanThreeOffAreNoNeighbours) {
  const RingGrid grid = Make({{{0, 0, 0}, 10}, {{0, 0, 0.2f}, 14}, {{0, 0, 0.6f}, 7}});
  EXPECT_EQ(grid.Search({0, 0, 0}, 2.f, {}).other_ring, 2);
}

TEST(RingGrid, NothingBeyondTheRadiusIsNearest) {
  const RingGrid grid = Make({{{0, 0, 0}, 1}});
  EXPECT_EQ(grid.Search({0.99f, 0, 0}, 1.f, {}).nearest, 0);
  EXPECT_EQ(grid.Search({1.01f, 0, 0}, 1.f, {}).nearest, -1);
}

TEST(RingGrid, PartsAreTheVoxelsOfAMetre) {
  const RingGrid grid = Make({{{0.1f, 0, 0}, 1}, {{0.9f, 0, 0}, 1}, {{1.1f, 0, 0}, 1}});
  EXPECT_EQ(grid.num_parts(), 2u);
  const auto part_at = [&](float x) { return grid.Search({x, 0, 0}, 0.2f, {}).part; };
  EXPECT_EQ(part_at(0.1f), part_at(0.9f));
  EXPECT_NE(part_at(0.9f), part_at(1.15f));
}

TEST(RingGrid, ClearForgetsEverything) {
  RingGrid grid = Make({{{0, 0, 0}, 1}, {{5, 5, 5}, 1}});
  grid.Clear();
  EXPECT_EQ(grid.size(), 0u);
  EXPECT_EQ(grid.Search({0, 0, 0}, 10.f, {}).nearest, -1);
  grid.Add({1, 1, 1}, 3);
  EXPECT_EQ(grid.Search({1, 1, 1}, 1.f, {}).nearest, 0);
}

// The grid is compared with a search through every point.
TEST(RingGrid, AgreesWithAPlainSearch) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(-4.f, 4.f);
  const auto draw = [&] { return Eigen::Vector3f{place(random), place(random), place(random)}; };
  std::vector<std::pair<Eigen::Vector3f, int>> points;
  for (int i = 0; i < 600; ++i) points.emplace_back(draw(), static_cast<int>(random() % 16));
  const RingGrid grid = Make(points);
  const Apart apart{0.3f, 0.6f};
  int num_full = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3f query = draw();
    const float radius = 1.2f;
    const auto nearest_of = [&](float limit, const auto& wanted) {
      std::int32_t best = -1;
      for (std::size_t k = 0; k < points.size(); ++k) {
        const float distance = (points[k].first - query).norm();
        if (distance >= limit || !wanted(k)) continue;
        limit = distance;
        best = static_cast<std::int32_t>(k);
      }
      return best;
    };
    const RingGrid::Found found = grid.Search(query, radius, apart);
    ASSERT_EQ(found.nearest, nearest_of(radius, [](std::size_t) { return true; }));
    if (found.nearest < 0) continue;
    const auto [at, ring] = points[static_cast<std::size_t>(found.nearest)];
    const auto is_apart = [&, at = at](std::size_t k, float m) {
      return (points[k].first - at).norm() >= m;
    };
    EXPECT_EQ(found.same_ring, nearest_of(radius + apart.same_ring_m, [&, ring = ring](auto k) {
                return points[k].second == ring && is_apart(k, apart.same_ring_m);
              }));
    EXPECT_EQ(found.other_ring, nearest_of(radius + apart.other_ring_m, [&, ring = ring](auto k) {
                const int gap = std::abs(points[k].second - ring);
                return gap > 0 && gap <= 3 && is_apart(k, apart.other_ring_m);
              }));
    num_full += found.same_ring >= 0 && found.other_ring >= 0;
  }
  EXPECT_GT(num_full, 100);
}

}  // namespace
}  // namespace lio
