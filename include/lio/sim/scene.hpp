// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Casts rays into a world with Embree. Moving objects are posed at each ray's own instant: within
// an interval Embree moves them linearly between poses `kMoverStep_s` apart, which at 10 m/s^2 is
// an error of at most 0.15 mm.
#pragma once

#include <limits>
#include <memory>
#include <span>

#include "lio/sim/world.hpp"

namespace lio::sim {

inline constexpr double kMoverStep_s = 0.011;
inline constexpr std::size_t kMaxTriangles = 2'000'000;  // some 400 MB with Embree's tree

struct Ray {
  Vector3f origin_m;
  Vector3f direction;      // unit vector
  float time_ratio = 0.0;  // 0 at the interval's begin, 1 at its end
};

struct Hit {
  static constexpr int kNothing = -2;
  static constexpr int kFixed = -1;

  float range_m = std::numeric_limits<float>::infinity();
  float cos_incidence = 1.0f;  // 1: the surface faces the ray
  Material material = Material::kAsphalt;
  int object = kNothing;                // index of the mover, or one of the above
  Vector3f normal = Vector3f::UnitZ();  // unit vector in world, on either side of the surface
};

class Scene {
 public:
  // Holds the movers over one interval of time; it is cheap to make and used by one thread.
  class Interval;

  // `world` must outlive it. A world of more than `max_triangles` is held in part: what lies
  // within `reach_m` of where rays are cast, so that Embree's tree does not grow with the way.
  // Throws std::runtime_error when Embree cannot start.
  explicit Scene(const World& world, double reach_m = std::numeric_limits<double>::infinity(),
                 std::size_t max_triangles = kMaxTriangles);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  // Rays of the interval see all that lies within `reach_m` of `place_m` (world).
  [[nodiscard]] Interval During(double begin_s, double end_s,
                                const Vector3& place_m = Vector3::Zero()) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

class Scene::Interval {
 public:
  ~Interval();
  Interval(Interval&&) noexcept;

  // Finds the nearest surface along each ray up to `max_range_m`. Both spans have the same size.
  // The result for a ray does not depend on the other rays.
  void Cast(std::span<const Ray> rays, float max_range_m, std::span<Hit> hits) const;

 private:
  friend class Scene;
  struct Impl;
  explicit Interval(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace lio::sim
