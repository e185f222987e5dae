// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Drops the cells that rays pass through: what they show has gone, or was never there.
#include <algorithm>
#include <cmath>
#include <optional>

#include "lio/map/gaussian_map.hpp"
#include "lio/map/map_parameters.hpp"

namespace lio {
namespace {

// Returns how far along a ray from a point it passes through the middle of the patch, that is
// within one standard deviation of its mean and inside of the voxel; nothing where it passes beside
// it or nearly along it. The point is from the voxel's centre, the direction of length 1.
std::optional<float> DistanceToMiddle(const SurfacePatch& patch, const Eigen::Vector3f& from,
                                      const Eigen::Vector3f& direction, float voxel_m) {
  Eigen::Vector3f facing = patch.normal;
  if (patch.kind == SurfacePatch::Kind::kVertical) {
    const Eigen::Vector3f up = patch.normal.cross(patch.tangent1_per_std).normalized();
    facing = (direction - direction.dot(up) * up).normalized();
  }
  const float cosine = facing.dot(direction);
  if (!(std::abs(cosine) > GaussianMapParameters::kMinPassCosine)) return std::nullopt;
  const float distance = facing.dot(patch.mean - from) / cosine;
  const Eigen::Vector3f at = from + distance * direction;
  const Eigen::Vector3f off = at - patch.mean;
  const float across = off.dot(patch.normal);
  const bool is_middle = across * across <= patch.thickness_var &&
                         std::abs(off.dot(patch.tangent1_per_std)) <= 1.f &&
                         std::abs(off.dot(patch.tangent2_per_std)) <= 1.f &&
                         at.cwiseAbs().maxCoeff() <= 0.5f * voxel_m;
  return is_middle ? std::optional(distance) : std::nullopt;
}

}  // namespace

// Each scan looks at other rays of its columns.
void GaussianMap::DropPassedCells(std::span<const Vector3> points_map, const Vector3& sensor_map) {
  constexpr std::size_t kSampling = GaussianMapParameters::kRaySampling;
  for (std::size_t i = scan_number_ % kSampling; i < points_map.size(); i += kSampling) {
    NoteRay(sensor_map, points_map[i]);
  }
}

void GaussianMap::NoteRay(const Vector3& sensor_map, const Vector3& point_map) {
  const double step_m = options_.voxel_m;
  const Vector3 ray = point_map - sensor_map;
  const double end_m = ray.norm() - step_m;  // the last edge length may be of what the ray hit
  const double end_steps =
      std::min(end_m / step_m, static_cast<double>(GaussianMapParameters::kMaxRay_voxels));
  const Vector3 direction = ray.normalized();
  on_ray_map_.clear();
  for (int i = 1; i < end_steps; ++i) on_ray_map_.push_back(sensor_map + i * step_m * direction);
  on_ray_.resize(on_ray_map_.size());
  FindAll(on_ray_map_, on_ray_);
  const Eigen::Vector3f along = direction.cast<float>();
  const auto voxel_m = static_cast<float>(step_m);
  for (std::size_t i = 0; i < on_ray_.size(); ++i) {
    const auto& [cell, local] = on_ray_[i];
    if (cell == kNoCell || patch(cell).thickness_var == 0.f) continue;
    const std::optional<float> further = DistanceToMiddle(patch(cell), local, along, voxel_m);
    if (further && static_cast<double>(i + 1) * step_m + *further < end_m) NotePass(cell);
  }
}

// Leaves, fences and the edges of things are passed by some rays and hit by others of the scan.
void GaussianMap::NotePass(std::int32_t cell) {
  Sums& sums = voxels_.Of<Sums>(cell);
  if (sums.is_kept || sums.touched == scan_number_) return;
  if (sums.passed_since != sums.touched) sums.num_passed = 0;
  sums.passed_since = sums.touched;
  if (++sums.num_passed >= GaussianMapParameters::kMinPasses) Remove(cell);
}

}  // namespace lio
