// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes points that fill a voxel of a GaussianMap, and finds the cell that the map made of them.
#pragma once

#include <random>
#include <vector>

#include "lio/map/gaussian_map.hpp"

namespace lio {

inline NdtOptions TestOptions() {
  NdtOptions options;
  options.voxel_m = 1.0;
  options.max_cell_points = 100;
  return options;
}

inline bool Has(const GaussianMap& map, const Vector3& point) {
  return map.Find(point).cell != GaussianMap::kNoCell;
}

inline const SurfacePatch& PatchAt(const GaussianMap& map, const Vector3& point) {
  return map.patch(map.Find(point).cell);
}

inline Vector3 CentreOf(int x, int y, int z) {
  return {x + 0.5, y + 0.5, z + 0.5};
}

// Returns points of a plane through `origin`, 2 cm thick, inside the voxel there.
inline std::vector<Vector3> PlanePoints(const Vector3& origin, const Vector3& normal, int num,
                                        unsigned seed = 1) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> wide(-0.45, 0.45);
  std::normal_distribution<double> thick(0.0, 0.02);
  const Quaternion turn = Quaternion::FromTwoVectors(Vector3::UnitZ(), normal);
  std::vector<Vector3> points;
  while (static_cast<int>(points.size()) < num) {
    const Vector3 offset = turn * Vector3{wide(random), wide(random), thick(random)};
    if (offset.cwiseAbs().maxCoeff() < 0.49) points.push_back(origin + offset);
  }
  return points;
}

}  // namespace lio
