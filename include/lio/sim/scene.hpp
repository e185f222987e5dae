// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Rays into a world, by Embree. Objects that move are posed at each ray's own instant: within an
// interval Embree moves them linearly between poses `kMoverStep_s` apart, which for a = 10 m/s^2
// is off by 0.15 mm at most.
#pragma once

#include <limits>
#include <memory>
#include <span>

#include "lio/sim/world.hpp"

namespace lio::sim {

inline constexpr double kMoverStep_s = 0.011;

struct Ray {
  Vector3f origin_m;
  Vector3f direction;      // unit
  float time_ratio = 0.0;  // 0 at the interval's begin, 1 at its end
};

struct Hit {
  static constexpr int kNothing = -2;
  static constexpr int kFixed = -1;

  float range_m = std::numeric_limits<float>::infinity();
  float cos_incidence = 1.0f;  // 1: the surface faces the ray
  Material material = Material::kAsphalt;
  int object = kNothing;  // index of the mover, or one of the above
};

class Scene {
 public:
  // The movers over one interval of time: cheap to make, used by one thread.
  class Interval;

  // Keeps what it needs of `world` but the movers' functions, which must outlive it. Throws
  // std::runtime_error when Embree cannot start.
  explicit Scene(const World& world);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  Interval During(double begin_s, double end_s) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

class Scene::Interval {
 public:
  ~Interval();
  Interval(Interval&&) noexcept;

  // The nearest surface along each ray up to `max_range_m`. Both spans have one size. The answer
  // for a ray does not depend on the others.
  void Cast(std::span<const Ray> rays, float max_range_m, std::span<Hit> hits) const;

 private:
  friend class Scene;
  struct Impl;
  explicit Interval(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace lio::sim
