// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "isosurface.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace lio::sim {
namespace {

constexpr int kBlock = 8;  // cells along an edge of a block, which is skipped where all is far

struct Corner {
  Vector3 p;
  double distance = 0.0;
};

Vector3 Crossing(const Corner& a, const Corner& b) {
  return a.p + a.distance / (a.distance - b.distance) * (b.p - a.p);
}

// A tetrahedron is cut in a triangle where one corner is on another side than the rest, and in a
// quad where two are.
void AddCut(Mesh& mesh, const std::array<const Corner*, 4>& tetrahedron, Material material) {
  std::array<const Corner*, 4> open{};
  std::array<const Corner*, 4> rock{};
  std::size_t num_open = 0;
  std::size_t num_rock = 0;
  for (const Corner* corner : tetrahedron) {
    (corner->distance < 0.0 ? open[num_open++] : rock[num_rock++]) = corner;
  }
  if (num_open == 2) {
    AddQuad(mesh, Crossing(*open[0], *rock[0]), Crossing(*open[0], *rock[1]),
            Crossing(*open[1], *rock[1]), Crossing(*open[1], *rock[0]), material);
  } else if (num_open == 1 || num_rock == 1) {
    const Corner& lone = num_open == 1 ? *open[0] : *rock[0];
    const auto& others = num_open == 1 ? rock : open;
    AddTriangle(mesh, Crossing(lone, *others[0]), Crossing(lone, *others[1]),
                Crossing(lone, *others[2]), material);
  }
}

// These are the six tetrahedra around the diagonal from corner 0 to corner 7; bit k of a corner's
// number tells whether it is at the upper end of axis k.
void AddCell(Mesh& mesh, const std::array<const Corner*, 8>& c, Material material) {
  constexpr std::array<std::array<std::size_t, 2>, 6> kBetween = {
      {{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}}};
  for (const auto& [a, b] : kBetween) AddCut(mesh, {c[0], c[a], c[b], c[7]}, material);
}

void AddBlock(Mesh& mesh, const DistanceFunction& distance, const Vector3& low, double cell_m,
              Material material) {
  constexpr std::size_t kCorners = kBlock + 1;
  std::vector<Corner> corners;
  corners.reserve(kCorners * kCorners * kCorners);
  for (int z = 0; z <= kBlock; ++z) {
    for (int y = 0; y <= kBlock; ++y) {
      for (int x = 0; x <= kBlock; ++x) {
        const Vector3 p = low + cell_m * Vector3(x, y, z);
        corners.push_back({p, distance(p)});
      }
    }
  }
  const auto cell_at = [&](std::size_t x, std::size_t y, std::size_t z) {
    std::array<const Corner*, 8> cell{};
    for (std::size_t i = 0; i < 8; ++i) {
      cell[i] = &corners[((z + (i >> 2)) * kCorners + y + (i >> 1 & 1)) * kCorners + x + (i & 1)];
    }
    return cell;
  };
  for (std::size_t z = 0; z < kBlock; ++z) {
    for (std::size_t y = 0; y < kBlock; ++y) {
      for (std::size_t x = 0; x < kBlock; ++x) AddCell(mesh, cell_at(x, y, z), material);
    }
  }
}

}  // namespace

void AddIsosurface(Mesh& mesh, const DistanceFunction& distance, const Vector3& low_m,
                   const Vector3& high_m, double cell_m, Material material) {
  const double block_m = kBlock * cell_m;
  const double far_m = 0.5 * std::sqrt(3.0) * block_m;
  const Eigen::Array3i num = ((high_m - low_m) / block_m).array().ceil().cast<int>();
  for (int z = 0; z < num.z(); ++z) {
    for (int y = 0; y < num.y(); ++y) {
      for (int x = 0; x < num.x(); ++x) {
        const Vector3 low = low_m + block_m * Vector3(x, y, z);
        if (std::abs(distance(low + Vector3::Constant(0.5 * block_m))) > far_m) continue;
        AddBlock(mesh, distance, low, cell_m, material);
      }
    }
  }
}

}  // namespace lio::sim
