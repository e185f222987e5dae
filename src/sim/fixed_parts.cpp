// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/fixed_parts.hpp"

#include <cmath>
#include <utility>

namespace lio::sim {
namespace {

constexpr double kCell_m = 200.0;     // a part of the world is for casting from one such cell
constexpr std::size_t kMaxParts = 2;  // are kept; intervals keep those that they cast into

}  // namespace

FixedParts::FixedParts(const PagedMesh& mesh, double reach_m, std::size_t max_triangles,
                       RTCDevice device)
    : mesh_(mesh),
      reach_m_(reach_m),
      is_whole_(std::isinf(reach_m) || mesh.num_triangles() <= max_triangles),
      device_(device) {}

Mesh FixedParts::MeshAround(std::array<std::int64_t, 2> cell) const {
  if (is_whole_) return mesh_.Whole();
  const Vector2 low(kCell_m * static_cast<double>(cell[0]), kCell_m * static_cast<double>(cell[1]));
  const Vector2 reach = Vector2::Constant(reach_m_);
  const Eigen::AlignedBox2d box(low - reach, low + Vector2::Constant(kCell_m) + reach);
  return mesh_.Around(box.cast<float>());
}

FixedPartPtr FixedParts::Make(std::array<std::int64_t, 2> cell) const {
  auto part = std::make_shared<FixedPart>();
  part->cell = cell;
  Mesh mesh = MeshAround(cell);
  part->scene = MakeMeshScene(device_, mesh);
  part->materials = std::move(mesh.materials);
  return part;
}

FixedPartPtr FixedParts::Around(const Vector3& place_m) {
  std::array<std::int64_t, 2> cell{};
  if (!is_whole_) {
    cell = {std::llround(std::floor(place_m.x() / kCell_m)),
            std::llround(std::floor(place_m.y() / kCell_m))};
  }
  const std::lock_guard lock(mutex_);
  for (const FixedPartPtr& part : parts_) {
    if (part->cell == cell) return part;
  }
  if (parts_.size() == kMaxParts) parts_.erase(parts_.begin());
  parts_.push_back(Make(cell));
  return parts_.back();
}

}  // namespace lio::sim
