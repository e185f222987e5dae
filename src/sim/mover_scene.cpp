// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/mover_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "lio/sim/scene.hpp"

namespace lio::sim {
namespace {

// Nothing drives as fast. A mover that jumps back to its start does so out of sight or in reach.
constexpr double kFastest_mps = 60.0;
constexpr std::int64_t kKeptFor = 64;    // intervals without use
constexpr unsigned kMaxTimeSteps = 129;  // as Embree allows

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

// Embree interpolates the matrices of two poses, which half a turn makes singular in between.
Quaternion ShortOfHalfATurn(const Quaternion& from, const Quaternion& to) {
  constexpr double kShare = 0.9999;
  const bool is_half_a_turn = from.angularDistance(to) > kShare * std::numbers::pi;
  return is_half_a_turn ? from.slerp(kShare, to) : to;
}

double RadiusOf(const Mesh& shape) {
  float radius_m = 0.0f;
  for (const Vector3f& vertex : shape.vertices_m) radius_m = std::max(radius_m, vertex.norm());
  return radius_m;
}

void SetMotion(const Mover& mover, double begin_s, double end_s, RTCGeometry instance) {
  const auto num_steps = std::clamp(
      static_cast<unsigned>(std::ceil((end_s - begin_s) / kMoverStep_s)) + 1u, 2u, kMaxTimeSteps);
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
}

}  // namespace

MoverScenes::MoverScenes(const World& world, double reach_m, RTCDevice device)
    : world_(world), reach_m_(reach_m), device_(device) {
  for (const Mesh& shape : world.shapes) radii_m_.push_back(RadiusOf(shape));
}

MoverScene MoverScenes::During(double begin_s, double end_s, const Vector3& place_m) {
  BeginInterval();
  MoverScene movers;
  movers.R_mover_world.resize(world_.movers.size(), Matrix3::Identity());
  const double seen_m = reach_m_ + kFastest_mps * (end_s - begin_s);
  for (std::size_t i = 0; i < world_.movers.size(); ++i) {
    const Mover& mover = world_.movers[i];
    const double away_m = (mover.T_world_mover(begin_s).translation - place_m).norm();
    if (away_m > seen_m + radii_m_[mover.shape]) continue;
    if (!movers.scene) {
      movers.scene.reset(rtcNewScene(device_));
      rtcSetSceneFlags(movers.scene.get(), RTC_SCENE_FLAG_ROBUST);
    }
    RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
    SetShape(mover.shape, instance);
    SetMotion(mover, begin_s, end_s, instance);
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(movers.scene.get(), instance, static_cast<unsigned>(i));
    rtcReleaseGeometry(instance);
    const Pose middle = mover.T_world_mover(0.5 * (begin_s + end_s));
    movers.R_mover_world[i] = middle.rotation.toRotationMatrix().transpose();
  }
  if (movers.scene) Commit(movers.scene.get());
  return movers;
}

void MoverScenes::SetShape(std::size_t shape, RTCGeometry instance) {
  const std::lock_guard lock(mutex_);
  Shape& known = shapes_[shape];
  if (!known.scene) known.scene = MakeMeshScene(device_, world_.shapes[shape]);
  known.last_interval = num_intervals_;
  rtcSetGeometryInstancedScene(instance, known.scene.get());
}

// Scenes that are still cast into keep the shapes that are dropped here, since Embree counts who
// uses them.
void MoverScenes::BeginInterval() {
  const std::lock_guard lock(mutex_);
  ++num_intervals_;
  std::erase_if(shapes_, [this](const auto& shape) {
    return shape.second.last_interval + kKeptFor < num_intervals_;
  });
}

}  // namespace lio::sim
