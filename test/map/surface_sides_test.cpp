// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/map/surface_sides.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace lio {
namespace {

using Points = std::vector<Eigen::Vector3f>;

// Adds a sheet of 6 m by 6 m with a point in each 0.2 m, 2 cm of noise, spanned by `u` and `v`.
void AddSheet(const Eigen::Vector3f& corner, const Eigen::Vector3f& u, const Eigen::Vector3f& v,
              Points& points) {
  std::mt19937_64 random(points.size() + 1);
  std::uniform_real_distribution<float> within(0.f, 0.2f);
  std::normal_distribution<float> noise(0.f, 0.02f);
  const Eigen::Vector3f normal = u.cross(v);
  for (int i = 0; i < 30; ++i) {
    for (int k = 0; k < 30; ++k) {
      const float along_u = 0.2f * static_cast<float>(i) + within(random);
      const float along_v = 0.2f * static_cast<float>(k) + within(random);
      points.emplace_back(corner + along_u * u + along_v * v + noise(random) * normal);
    }
  }
}

// The share of points from `begin` on, away from the sheets' rims, whose side is `side`.
double ShareOf(const Points& points, std::size_t begin, const Eigen::Vector3f& side) {
  const auto sides = SurfaceSides(points);
  int num = 0;
  int num_right = 0;
  for (std::size_t i = begin; i < begin + 900; ++i) {
    if ((points[i].head<2>().array() - 3.f).abs().maxCoeff() > 2.f) continue;
    ++num;
    num_right += (sides[i] - side).norm() < 0.4f ? 1 : 0;
  }
  return static_cast<double>(num_right) / num;
}

const Eigen::Vector3f kX{1.f, 0.f, 0.f};
const Eigen::Vector3f kY{0.f, 1.f, 0.f};
const Eigen::Vector3f kZ{0.f, 0.f, 1.f};

TEST(SurfaceSides, SheetsOfASlabAreSeenFromOutside) {
  Points points;
  AddSheet({0.f, 0.f, 3.3f}, kX, kY, points);  // the floor above
  AddSheet({0.f, 0.f, 3.0f}, kX, kY, points);  // the ceiling below
  EXPECT_GT(ShareOf(points, 0, kZ), 0.5);
  EXPECT_GT(ShareOf(points, 900, -kZ), 0.5);
  EXPECT_EQ(ShareOf(points, 0, -kZ), 0.0) << "rather none than the wrong one";
  EXPECT_EQ(ShareOf(points, 900, kZ), 0.0);
}

TEST(SurfaceSides, SingleSheetMayBeSeenFromBoth) {
  Points points;
  AddSheet({0.f, 0.f, 0.f}, kX, kY, points);
  AddSheet({0.f, 0.f, 2.7f}, kX, kY, points);  // too far off for a slab
  EXPECT_GT(ShareOf(points, 0, Eigen::Vector3f::Zero()), 0.95);
}

// Else the floor beside a wall would look down.
TEST(SurfaceSides, WallOnAFloorTellsNothing) {
  Points points;
  AddSheet({0.f, 0.f, 0.f}, kX, kY, points);
  AddSheet({0.f, 3.f, 0.f}, kX, kZ, points);
  const auto sides = SurfaceSides(points);
  int num_down = 0;
  for (std::size_t i = 0; i < 900; ++i) num_down += sides[i].z() < -0.5f ? 1 : 0;
  EXPECT_LT(num_down, 20);
}

TEST(SurfaceSides, MoreThreadsTellTheSame) {
  Points points;
  AddSheet({0.f, 0.f, 3.3f}, kX, kY, points);
  AddSheet({0.f, 0.f, 3.0f}, kX, kY, points);
  EXPECT_EQ(SurfaceSides(points), SurfaceSides(points, Workers(3)));
  EXPECT_TRUE(SurfaceSides({}).empty());
}

}  // namespace
}  // namespace lio
