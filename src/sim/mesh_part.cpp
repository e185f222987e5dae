// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "sim/mesh_part.hpp"

namespace lio::sim {

void AddPartOf(const Mesh& mesh, const Eigen::AlignedBox2f& box_m, Mesh& part) {
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<std::uint32_t> in_part(mesh.vertices_m.size(), kNone);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Eigen::AlignedBox2f bounds;
    for (const std::uint32_t v : mesh.triangles[i]) bounds.extend(mesh.vertices_m[v].head<2>());
    if (!box_m.intersects(bounds)) continue;
    std::array<std::uint32_t, 3> triangle = mesh.triangles[i];
    for (std::uint32_t& v : triangle) {
      if (in_part[v] == kNone) {
        in_part[v] = static_cast<std::uint32_t>(part.vertices_m.size());
        part.vertices_m.push_back(mesh.vertices_m[v]);
      }
      v = in_part[v];
    }
    part.triangles.push_back(triangle);
    part.materials.push_back(mesh.materials[i]);
  }
}

}  // namespace lio::sim
