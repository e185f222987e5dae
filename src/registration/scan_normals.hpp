// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Fits the normal at each point of a scan, from the moments of the 27 voxels around it: one pass
// sums them up, and there is no neighbour search. Voxels grow with range as beams spread: each
// range has its level, twice as coarse as the one before.
#pragma once

#include <array>
#include <span>

#include "lio/base/rotation.hpp"
#include "lio/base/voxel_map.hpp"
#include "lio/map/point_with_normal.hpp"
#include "lio/registration/gicp_options.hpp"
#include "lio/registration/registration_parameters.hpp"

namespace lio {

class ScanNormals {
 public:
  explicit ScanNormals(const GicpOptions& options) : options_(options) {}

  // Sums up a scan; forgets the one before.
  void SetScan(std::span<const Eigen::Vector3f> points);
  // Returns a point of the scan with its normal; without one where the surroundings are
  // rank-deficient: too few points, points along a line, as those of a single ring are, or no
  // surface.
  [[nodiscard]] PointWithNormal At(const Eigen::Vector3f& point) const;

 private:
  // Sums over points, from the scan's origin, in double: 100 m squared leaves 1e-12 m^2.
  struct Moments {
    double count = 0, x = 0, y = 0, z = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

    void Add(const Vector3& point);
    void operator+=(const Moments& other);
  };
  struct Level {
    float voxel_m = 0.f;
    float max_range_m = 0.f;
    VoxelMap<Moments> voxels;
  };
  static constexpr std::size_t kNumLevels = ScanNormalParameters::kNumLevels;

  std::size_t LevelOf(float range_m) const;
  static void AddTo(Level& level, const Eigen::Vector3f& point);
  // Fills the normal and its variances at the result's position, unless the moments of the points
  // around it show no surface.
  void FitNormal(const Moments& around, float voxel_m, PointWithNormal& result) const;

  GicpOptions options_;
  std::array<Level, kNumLevels> levels_;
};

}  // namespace lio
