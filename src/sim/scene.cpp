// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/scene.hpp"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/mesh_part.hpp"

namespace lio::sim {

// A class has members of these types, which therefore are not in the unnamed namespace.
struct DeviceDeleter {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DevicePtr = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceDeleter>;
using ScenePtr = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneDeleter>;

namespace {

constexpr int kLanes = 8;
constexpr double kCell_m = 200.0;     // a part of the world is for casting from one such cell
constexpr std::size_t kMaxParts = 2;  // are kept; intervals keep those that they cast into

// Builds the scene's tree by the calling thread alone, so that the tree, and with it the choice
// between equally near hits, does not depend on the number of threads. Embree's own option for
// that, threads=1, would hold all of TBB to one thread as long as the device lives.
void Commit(RTCScene scene) {
  tbb::task_arena(1).execute([scene] { rtcCommitScene(scene); });
}

ScenePtr MakeMeshScene(RTCDevice device, const Mesh& mesh) {
  ScenePtr scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  if (!mesh.triangles.empty()) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(Vector3f), mesh.vertices_m.size());
    std::copy(mesh.vertices_m.begin(), mesh.vertices_m.end(), static_cast<Vector3f*>(vertices));
    using Triangle = std::array<std::uint32_t, 3>;
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              sizeof(Triangle), mesh.triangles.size());
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), static_cast<Triangle*>(triangles));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
  }
  Commit(scene.get());
  return scene;
}

// Returns a column-major 3x4 matrix, the form in which Embree takes transforms.
std::array<float, 12> ToColumns(const Pose& pose) {
  const Matrix3 rotation = pose.rotation.toRotationMatrix();
  std::array<float, 12> columns{};
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      columns[static_cast<std::size_t>(3 * c + r)] = static_cast<float>(rotation(r, c));
    }
  }
  for (int r = 0; r < 3; ++r) {
    columns[static_cast<std::size_t>(9 + r)] = static_cast<float>(pose.translation[r]);
  }
  return columns;
}

}  // namespace

// Holds what stands still, in the whole world or within one cell of it and its surroundings.
struct FixedPart {
  std::array<std::int64_t, 2> cell{};
  ScenePtr scene;
  std::vector<Material> materials;
};
using FixedPartPtr = std::shared_ptr<const FixedPart>;

struct Scene::Impl {
  Impl(const World& world_, double reach_m_, std::size_t max_triangles)
      : world(world_),
        reach_m(reach_m_),
        is_whole(std::isinf(reach_m_) || world_.fixed.triangles.size() <= max_triangles) {}

  // Returns what is within reach of the place. Safe from any thread.
  FixedPartPtr FixedAround(const Vector3& place_m);
  FixedPartPtr MakePart(std::array<std::int64_t, 2> cell) const;

  const World& world;
  double reach_m;
  bool is_whole;
  DevicePtr device;
  std::vector<ScenePtr> shapes;
  std::mutex mutex;  // guards `parts`
  std::vector<FixedPartPtr> parts;
};

FixedPartPtr Scene::Impl::MakePart(std::array<std::int64_t, 2> cell) const {
  auto part = std::make_shared<FixedPart>();
  part->cell = cell;
  if (is_whole) {
    part->scene = MakeMeshScene(device.get(), world.fixed);
    part->materials = world.fixed.materials;
    return part;
  }
  const Vector2 low(kCell_m * static_cast<double>(cell[0]), kCell_m * static_cast<double>(cell[1]));
  const Vector2 reach = Vector2::Constant(reach_m);
  const Eigen::AlignedBox2d box(low - reach, low + Vector2::Constant(kCell_m) + reach);
  Mesh mesh = PartOf(world.fixed, box.cast<float>());
  part->scene = MakeMeshScene(device.get(), mesh);
  part->materials = std::move(mesh.materials);
  return part;
}

FixedPartPtr Scene::Impl::FixedAround(const Vector3& place_m) {
  std::array<std::int64_t, 2> cell{};
  if (!is_whole) {
    cell = {std::llround(std::floor(place_m.x() / kCell_m)),
            std::llround(std::floor(place_m.y() / kCell_m))};
  }
  const std::lock_guard lock(mutex);
  for (const FixedPartPtr& part : parts) {
    if (part->cell == cell) return part;
  }
  if (parts.size() == kMaxParts) parts.erase(parts.begin());
  parts.push_back(MakePart(cell));
  return parts.back();
}

struct Scene::Interval::Impl {
  Hit HitOf(const RTCRayHit8& packet, std::size_t i, const Ray& ray) const;

  const Scene::Impl* scene = nullptr;
  FixedPartPtr fixed;
  ScenePtr movers;                // null when nothing moves
  std::vector<Matrix3> to_mover;  // rotation from world to mover at the interval's middle
};

// Embree casts with the instructions that every x86-64 processor has, so that the last bits of
// ranges do not depend on the processor.
#if defined(__x86_64__)
constexpr const char* kEmbreeConfiguration = "isa=sse2";
#else
constexpr const char* kEmbreeConfiguration = "";
#endif

Scene::Scene(const World& world, double reach_m, std::size_t max_triangles)
    : impl_(std::make_unique<Impl>(world, reach_m, max_triangles)) {
  impl_->device.reset(rtcNewDevice(kEmbreeConfiguration));
  if (!impl_->device) {
    throw std::runtime_error("Embree cannot start: error " +
                             std::to_string(rtcGetDeviceError(nullptr)));
  }
  for (const Mesh& shape : world.shapes) {
    impl_->shapes.push_back(MakeMeshScene(impl_->device.get(), shape));
  }
}

Scene::~Scene() = default;

// Embree interpolates the matrices of two poses, which half a turn makes singular in between.
static Quaternion ShortOfHalfATurn(const Quaternion& from, const Quaternion& to) {
  constexpr double kShare = 0.9999;
  const bool is_half_a_turn = from.angularDistance(to) > kShare * std::numbers::pi;
  return is_half_a_turn ? from.slerp(kShare, to) : to;
}

Scene::Interval Scene::During(double begin_s, double end_s, const Vector3& place_m) const {
  auto interval = std::make_unique<Interval::Impl>();
  interval->scene = impl_.get();
  interval->fixed = impl_->FixedAround(place_m);
  const std::vector<Mover>& movers = impl_->world.movers;
  if (movers.empty()) return Interval(std::move(interval));
  const auto num_steps =
      std::clamp(static_cast<unsigned>(std::ceil((end_s - begin_s) / kMoverStep_s)) + 1u, 2u, 129u);
  interval->movers.reset(rtcNewScene(impl_->device.get()));
  rtcSetSceneFlags(interval->movers.get(), RTC_SCENE_FLAG_ROBUST);
  for (const Mover& mover : movers) {
    RTCGeometry instance = rtcNewGeometry(impl_->device.get(), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, impl_->shapes[mover.shape].get());
    rtcSetGeometryTimeStepCount(instance, num_steps);
    std::optional<Quaternion> before;
    for (unsigned i = 0; i < num_steps; ++i) {
      const double t_s = begin_s + (end_s - begin_s) * i / (num_steps - 1);
      Pose T_world_mover = mover.T_world_mover(t_s);
      if (before) T_world_mover.rotation = ShortOfHalfATurn(*before, T_world_mover.rotation);
      before = T_world_mover.rotation;
      const std::array<float, 12> columns = ToColumns(T_world_mover);
      rtcSetGeometryTransform(instance, i, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
    }
    rtcCommitGeometry(instance);
    rtcAttachGeometry(interval->movers.get(), instance);
    rtcReleaseGeometry(instance);
    const Pose middle = mover.T_world_mover(0.5 * (begin_s + end_s));
    interval->to_mover.push_back(middle.rotation.toRotationMatrix().transpose());
  }
  Commit(interval->movers.get());
  return Interval(std::move(interval));
}

Scene::Interval::Interval(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Scene::Interval::~Interval() = default;
Scene::Interval::Interval(Interval&&) noexcept = default;

// Fills the packet's lanes with `rays`; the lanes beyond repeat the last ray and are not valid.
static void Load(std::span<const Ray> rays, float max_range_m, RTCRayHit8& packet,
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
    direction = (to_mover[mover] * direction.cast<double>()).cast<float>();
    hit.normal = (to_mover[mover].transpose() * hit.normal.cast<double>()).cast<float>();
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
    if (impl_->movers) rtcIntersect8(valid.data(), impl_->movers.get(), &context, &packet);
    for (std::size_t i = 0; i < num; ++i)
      hits[first + i] = impl_->HitOf(packet, i, rays[first + i]);
  }
}

}  // namespace lio::sim
