// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/scan_normals.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace lio {
namespace {

// Returns points on a plane around `centre`, spanned by a and b, with noise along the normal.
std::vector<Eigen::Vector3f> Patch(const Eigen::Vector3f& centre, const Eigen::Vector3f& a,
                                   const Eigen::Vector3f& b, int per_side, float noise_m) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0.f, 1.f);
  const Eigen::Vector3f normal = a.cross(b).normalized();
  std::vector<Eigen::Vector3f> points;
  for (int i = -per_side; i <= per_side; ++i) {
    for (int j = -per_side; j <= per_side; ++j) {
      const float u = static_cast<float>(i) / static_cast<float>(per_side);
      const float v = static_cast<float>(j) / static_cast<float>(per_side);
      points.push_back(centre + u * a + v * b + noise_m * noise(random) * normal);
    }
  }
  return points;
}

TEST(ScanNormals, PlaneHasItsNormalAtEveryRange) {
  for (const float range : {2.f, 9.9f, 10.1f, 35.f, 70.f}) {
    const float size = 0.05f * range + 0.5f;
    const Eigen::Vector3f a(0, size, 0);
    const Eigen::Vector3f b(0.2f * size, 0, size);
    ScanNormals normals(GicpOptions{});
    const auto points = Patch({range, 0.1f, 0.2f}, a, b, 10, 0.01f);
    normals.SetScan(points);
    const PointWithNormal point = normals.At({range, 0.1f, 0.2f});
    ASSERT_TRUE(point.HasNormal()) << range;
    EXPECT_GT(std::abs(point.normal.dot(a.cross(b).normalized())), 0.998f) << range;
    EXPECT_NEAR(point.normal.norm(), 1.f, 1e-5f);
    EXPECT_FLOAT_EQ(point.thickness_var, 0.03f * 0.03f);  // the floor
    EXPECT_LT(point.normal_var, 0.01f);
  }
}

TEST(ScanNormals, ThicknessIsTheScatterAlongTheNormal) {
  ScanNormals normals(GicpOptions{});
  const Eigen::Vector3f centre(5, 0, 0);
  normals.SetScan(Patch(centre, {0, 0.6f, 0}, {0, 0, 0.6f}, 12, 0.06f));
  const PointWithNormal point = normals.At(centre);
  ASSERT_TRUE(point.HasNormal());
  EXPECT_NEAR(std::sqrt(point.thickness_var), 0.06, 0.015);
}

TEST(ScanNormals, BendIsThatOfTheVaultItSees) {
  constexpr float kRadius_m = 1.5f;
  const Eigen::Vector3f centre(5, 0, 0);
  auto vault = Patch(centre, {0, 0.6f, 0}, {0, 0, 0.6f}, 12, 0.f);
  for (Eigen::Vector3f& point : vault) point.x() -= point.y() * point.y() / (2.f * kRadius_m);
  ScanNormals normals(GicpOptions{});
  normals.SetScan(vault);
  const PointWithNormal point = normals.At(centre);
  ASSERT_TRUE(point.HasNormal());
  // At a distance o it is o^2 / (2 R) away from its plane.
  EXPECT_NEAR(std::sqrt(point.bend_var), 1.f / (2.f * kRadius_m), 0.05f);
}

TEST(ScanNormals, OneRingIsNoSurface) {
  ScanNormals normals(GicpOptions{});
  normals.SetScan(Patch({6, 0, -1.5f}, {0, 1.f, 0}, {0, 0, 0.005f}, 15, 0.01f));
  EXPECT_FALSE(normals.At({6, 0, -1.5f}).HasNormal());
}

TEST(ScanNormals, FewPointsOrAClusterAreNoSurface) {
  ScanNormals normals(GicpOptions{});
  normals.SetScan(std::vector<Eigen::Vector3f>{{6, 0, 0}, {6, 0.1f, 0}, {6, 0, 0.1f}});
  EXPECT_FALSE(normals.At({6, 0, 0}).HasNormal());
  EXPECT_FALSE(normals.At({20, 3, 0}).HasNormal());  // nothing there
  std::mt19937 random(2);
  std::normal_distribution<float> noise(0.f, 0.2f);
  std::vector<Eigen::Vector3f> bush;
  bush.reserve(300);
  for (int i = 0; i < 300; ++i) bush.push_back({6 + noise(random), noise(random), noise(random)});
  normals.SetScan(bush);
  EXPECT_FALSE(normals.At({6, 0, 0}).HasNormal());
}

TEST(ScanNormals, TheScanBeforeIsForgotten) {
  ScanNormals normals(GicpOptions{});
  normals.SetScan(Patch({5, 0, 0}, {0, 0.6f, 0}, {0, 0, 0.6f}, 12, 0.f));
  normals.SetScan(std::vector<Eigen::Vector3f>{});
  EXPECT_FALSE(normals.At({5, 0, 0}).HasNormal());
}

}  // namespace
}  // namespace lio
