// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Keeps the points of one scan with their rings, for LOAM's scan-to-scan search: around a place,
// the nearest point, the nearest one on the same ring and the nearest one on a neighbouring ring.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lio/base/rotation.hpp"
#include "lio/base/voxel_map.hpp"
#include "lio/registration/registration_parameters.hpp"

namespace lio {

class RingGrid {
 public:
  void Clear();
  void Add(const Eigen::Vector3f& point, std::uint16_t ring);
  std::size_t size() const { return points_.size(); }

  struct Found {
    std::int32_t nearest = -1;
    std::int32_t same_ring = -1;   // the nearest one on its ring that is far enough from it
    std::int32_t other_ring = -1;  // the nearest one at most three rings off it, likewise
    std::int32_t part = -1;        // the voxel of `nearest`
  };
  // How far the second and third point must be from the nearest one, for a line or a plane through
  // them to be known: noise tilts shorter ones.
  struct Apart {
    float same_ring_m = 0.f;
    float other_ring_m = 0.f;
    float On(int ring_gap) const { return ring_gap == 0 ? same_ring_m : other_ring_m; }
  };
  [[nodiscard]] Found Search(const Eigen::Vector3f& query, float radius_m,
                             const Apart& apart) const;
  const Eigen::Vector3f& point(std::int32_t i) const {
    return points_[static_cast<std::size_t>(i)].position;
  }
  // Returns an upper bound of the numbers of parts.
  std::size_t num_parts() const { return voxels_.capacity(); }

 private:
  static constexpr float kVoxel_m = LoamScanParameters::kGridVoxel_m;
  struct Point {
    Eigen::Vector3f position;
    std::int32_t next = -1;  // next point of the same voxel
    std::uint16_t ring = 0;
  };
  template <class Visit>
  void ForEachNear(const Eigen::Vector3f& query, float radius_m, const Visit& visit) const;

  struct Chain {
    std::int32_t first = -1;  // point
  };
  VoxelMap<Chain> voxels_;
  std::vector<Point> points_;
};

}  // namespace lio
