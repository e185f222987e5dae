// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds what stands still ready to cast into: the whole world, or of a large one the parts that are
// being seen, so that Embree's trees do not grow with the way.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "lio/sim/paged_mesh.hpp"
#include "sim/embree.hpp"

namespace lio::sim {

// Is the whole world, or one cell of it and its surroundings.
struct FixedPart {
  std::array<std::int64_t, 2> cell{};
  ScenePtr scene;
  std::vector<Material> materials;
};
using FixedPartPtr = std::shared_ptr<const FixedPart>;

class FixedParts {
 public:
  // `mesh` and `device` must outlive it. A mesh of more than `max_triangles` is held in parts, an
  // endless reach needs all of it.
  FixedParts(const PagedMesh& mesh, double reach_m, std::size_t max_triangles, RTCDevice device);

  // Returns what is within reach of the place (world). Safe from any thread.
  [[nodiscard]] FixedPartPtr Around(const Vector3& place_m);

 private:
  [[nodiscard]] Mesh MeshAround(std::array<std::int64_t, 2> cell) const;
  [[nodiscard]] FixedPartPtr Make(std::array<std::int64_t, 2> cell) const;

  const PagedMesh& mesh_;
  double reach_m_;
  bool is_whole_;
  RTCDevice device_;
  std::mutex mutex_;  // guards `parts_`
  std::vector<FixedPartPtr> parts_;
};

}  // namespace lio::sim
