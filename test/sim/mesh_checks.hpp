// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives measures of meshes, and rays into a world, for tests.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "lio/sim/scene.hpp"

namespace lio::test {

struct Extent {
  sim::Vector3f low = sim::Vector3f::Constant(1e9f);
  sim::Vector3f high = sim::Vector3f::Constant(-1e9f);

  sim::Vector3f Size() const { return high - low; }
};

// Returns the extent of the triangles that `wanted` accepts, or of all without `wanted`.
inline Extent ExtentOf(const sim::Mesh& mesh,
                       const std::function<bool(sim::Material)>& wanted = nullptr) {
  Extent extent;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (wanted && !wanted(mesh.materials[i])) continue;
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      extent.low = extent.low.cwiseMin(mesh.vertices_m[vertex]);
      extent.high = extent.high.cwiseMax(mesh.vertices_m[vertex]);
    }
  }
  return extent;
}
inline Extent ExtentOf(const sim::Mesh& mesh, sim::Material material) {
  return ExtentOf(mesh, [material](sim::Material m) { return m == material; });
}

inline std::set<sim::Material> MaterialsOf(const sim::Mesh& mesh) {
  return {mesh.materials.begin(), mesh.materials.end()};
}

inline double AreaOf(const sim::Mesh& mesh) {
  double area_m2 = 0.0;
  for (const auto& t : mesh.triangles) {
    const sim::Vector3f& a = mesh.vertices_m[t[0]];
    area_m2 += 0.5 * (mesh.vertices_m[t[1]] - a).cross(mesh.vertices_m[t[2]] - a).norm();
  }
  return area_m2;
}

inline void ExpectSound(const sim::Mesh& mesh) {
  ASSERT_FALSE(mesh.triangles.empty());
  ASSERT_EQ(mesh.triangles.size(), mesh.materials.size());
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t i : triangle) ASSERT_LT(i, mesh.vertices_m.size());
  }
  for (const sim::Vector3f& p : mesh.vertices_m) ASSERT_TRUE(p.allFinite());
}

inline sim::Hit CastOne(const sim::Scene::Interval& interval, const sim::Vector3f& from,
                        const sim::Vector3f& direction, float time_ratio = 0.0f) {
  const sim::Ray ray{from, direction.normalized(), time_ratio};
  sim::Hit hit;
  interval.Cast({&ray, 1}, 100.0f, {&hit, 1});
  return hit;
}

// Makes a world of one static mesh.
class StillScene {
 public:
  explicit StillScene(const sim::Mesh& mesh)
      : world_(WorldOf(mesh)), scene_(world_), interval_(scene_.During(0, 0.1)) {}

  sim::Hit Cast(const Vector3& from, const Vector3& direction) const {
    return CastOne(interval_, from.cast<float>(), direction.cast<float>());
  }
  // Returns the highest surface above a place, and its height.
  sim::Hit Down(const sim::Vector2& p, double& height_m) const {
    const sim::Hit hit = Cast({p.x(), p.y(), 60.0}, -Vector3::UnitZ());
    height_m = 60.0 - hit.range_m;
    return hit;
  }

 private:
  static sim::World WorldOf(const sim::Mesh& mesh) {
    sim::World world;
    world.fixed.page() = mesh;
    return world;
  }
  sim::World world_;
  sim::Scene scene_;
  sim::Scene::Interval interval_;
};

}  // namespace lio::test
