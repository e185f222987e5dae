// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/scene.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "sim/fixed_parts.hpp"
#include "sim/mover_scene.hpp"

namespace lio::sim {
namespace {

constexpr int kLanes = 8;

// Fills the packet's lanes with `rays`; the lanes beyond repeat the last ray and are not valid.
void Load(std::span<const Ray> rays, float max_range_m, RTCRayHit8& packet,
          std::array<int, kLanes>& valid) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const Ray& ray = rays[std::min(i, rays.size() - 1)];
    valid[i] = i < rays.size() ? -1 : 0;
    packet.ray.org_x[i] = ray.origin_m.x();
    packet.ray.org_y[i] = ray.origin_m.y();
    packet.ray.org_z[i] = ray.origin_m.z();
    packet.ray.dir_x[i] = ray.direction.x();
    packet.ray.dir_y[i] = ray.direction.y();
    packet.ray.dir_z[i] = ray.direction.z();
    packet.ray.tnear[i] = 0.0f;
    packet.ray.tfar[i] = max_range_m;
    packet.ray.time[i] = ray.time_ratio;
    packet.ray.mask[i] = ~0u;
    packet.ray.flags[i] = 0;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
}

}  // namespace

struct Scene::Impl {
  Impl(const World& world_, double reach_m, std::size_t max_triangles)
      : world(world_),
        device(MakeDevice()),
        fixed(world_.fixed, reach_m, max_triangles, device.get()),
        movers(world_, reach_m, device.get()) {}

  const World& world;
  DevicePtr device;
  FixedParts fixed;
  MoverScenes movers;
};

struct Scene::Interval::Impl {
  Hit HitOf(const RTCRayHit8& packet, std::size_t i, const Ray& ray) const;

  const Scene::Impl* scene = nullptr;
  FixedPartPtr fixed;
  MoverScene movers;
};

Scene::Scene(const World& world, double reach_m, std::size_t max_triangles)
    : impl_(std::make_unique<Impl>(world, reach_m, max_triangles)) {}

Scene::~Scene() = default;

Scene::Interval Scene::During(double begin_s, double end_s, const Vector3& place_m) const {
  auto interval = std::make_unique<Interval::Impl>();
  interval->scene = impl_.get();
  interval->fixed = impl_->fixed.Around(place_m);
  interval->movers = impl_->movers.During(begin_s, end_s, place_m);
  return Interval(std::move(interval));
}

Scene::Interval::Interval(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Scene::Interval::~Interval() = default;
Scene::Interval::Interval(Interval&&) noexcept = default;

// Returns the hit of lane i of the packet.
Hit Scene::Interval::Impl::HitOf(const RTCRayHit8& packet, std::size_t i, const Ray& ray) const {
  Hit hit;
  if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) return hit;
  const Vector3f normal(packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]);
  Vector3f direction = ray.direction;
  hit.normal = normal.normalized();
  const unsigned mover = packet.hit.instID[0][i];
  const unsigned triangle = packet.hit.primID[i];
  hit.range_m = packet.ray.tfar[i];
  if (mover == RTC_INVALID_GEOMETRY_ID) {
    hit.object = Hit::kFixed;
    hit.material = fixed->materials[triangle];
  } else {
    hit.object = static_cast<int>(mover);
    const World& world = scene->world;
    hit.material = world.shapes[world.movers[mover].shape].materials[triangle];
    direction = (movers.R_mover_world[mover] * direction.cast<double>()).cast<float>();
    hit.normal =
        (movers.R_mover_world[mover].transpose() * hit.normal.cast<double>()).cast<float>();
  }
  hit.cos_incidence = std::abs(normal.dot(direction)) / normal.norm();
  return hit;
}

void Scene::Interval::Cast(std::span<const Ray> rays, float max_range_m,
                           std::span<Hit> hits) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  alignas(32) RTCRayHit8 packet;
  alignas(32) std::array<int, kLanes> valid;
  for (std::size_t first = 0; first < rays.size(); first += kLanes) {
    const std::size_t num = std::min<std::size_t>(kLanes, rays.size() - first);
    Load(rays.subspan(first, num), max_range_m, packet, valid);
    rtcIntersect8(valid.data(), impl_->fixed->scene.get(), &context, &packet);
    if (impl_->movers.scene) {
      rtcIntersect8(valid.data(), impl_->movers.scene.get(), &context, &packet);
    }
    for (std::size_t i = 0; i < num; ++i)
      hits[first + i] = impl_->HitOf(packet, i, rays[first + i]);
  }
}

}  // namespace lio::sim
