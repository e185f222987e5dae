// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/reduce.hpp"

#include <algorithm>
#include <cmath>

#include "lio/map/voxel_key.hpp"
#include "scan/sampling.hpp"

namespace lio {
namespace {

constexpr std::size_t kInitialSlots = 1u << 14;

struct Voxel {
  VoxelKey key;
  float distance_sq;  // of the point from the voxel's centre, in voxels
};

Voxel VoxelOf(const LidarPoint& point, float inverse_voxel) {
  const float x = point.x_m * inverse_voxel;
  const float y = point.y_m * inverse_voxel;
  const float z = point.z_m * inverse_voxel;
  const std::int32_t ix = FloorToInt(x);
  const std::int32_t iy = FloorToInt(y);
  const std::int32_t iz = FloorToInt(z);
  const float dx = x - static_cast<float>(ix) - 0.5f;
  const float dy = y - static_cast<float>(iy) - 0.5f;
  const float dz = z - static_cast<float>(iz) - 0.5f;
  return {PackVoxel(ix, iy, iz), dx * dx + dy * dy + dz * dz};
}

}  // namespace

ScanReducer::ScanReducer(const ReduceOptions& options, const LidarRig& rig)
    : options_(options),
      filter_(rig),
      voxel_m_(static_cast<float>(options.voxel_m)),
      slots_(kInitialSlots) {}

std::size_t ScanReducer::FillSlots(const Sweep& sweep, int& num_nonfinite) {
  if (++epoch_ == 0) {  // wrapped: forget every slot
    std::fill(slots_.begin(), slots_.end(), Slot{});
    epoch_ = 1;
  }
  const float inverse_voxel = 1.0f / voxel_m_;
  const std::size_t mask = slots_.size() - 1;
  std::size_t num_kept = 0;
  num_nonfinite = 0;
  const std::uint32_t share = SampleShare(sweep.points.size());
  for (std::uint32_t i = 0; i < sweep.points.size(); ++i) {
    const LidarPoint& point = sweep.points[i];
    if (!IsFinite(point)) {
      ++num_nonfinite;
      continue;
    }
    if (Sample(point) >= share || !filter_.IsWanted(point)) continue;
    const Voxel voxel = VoxelOf(point, inverse_voxel);
    std::size_t at = HashVoxel(voxel.key) & mask;
    while (slots_[at].epoch == epoch_ && slots_[at].key != voxel.key) at = (at + 1) & mask;
    Slot& slot = slots_[at];
    if (slot.epoch != epoch_) {
      slot = {voxel.key, epoch_, i, voxel.distance_sq};
      if (++num_kept * 2 > slots_.size()) return kTableFull;
    } else if (voxel.distance_sq < slot.distance_sq ||
               (voxel.distance_sq == slot.distance_sq &&
                Precedes(point, sweep.points[slot.index]))) {
      slot.index = i;
      slot.distance_sq = voxel.distance_sq;
    }
  }
  return num_kept;
}

// By time, then ring: a key beside the index keeps the sort from chasing points all over the sweep.
std::vector<ScanReducer::Chosen> ScanReducer::SortedChoice(const Sweep& sweep,
                                                           std::size_t num_kept) const {
  std::vector<Chosen> chosen;
  chosen.reserve(num_kept);
  for (const Slot& slot : slots_) {
    if (slot.epoch != epoch_) continue;
    const LidarPoint& point = sweep.points[slot.index];
    const std::uint64_t key = (std::uint64_t{point.t_offset_ns} << 16) | point.ring;
    chosen.push_back({key, slot.index});
  }
  std::sort(chosen.begin(), chosen.end(), [&](const Chosen& a, const Chosen& b) {
    return a.key != b.key ? a.key < b.key : Precedes(sweep.points[a.index], sweep.points[b.index]);
  });
  return chosen;
}

ReducedScan ScanReducer::Reduce(const Sweep& sweep) {
  ReducedScan result;
  result.num_raw = static_cast<int>(sweep.points.size());
  result.voxel_m = voxel_m_;
  std::size_t num_kept = FillSlots(sweep, result.num_nonfinite);
  while (num_kept == kTableFull) {
    slots_.assign(slots_.size() * 4, Slot{});
    num_kept = FillSlots(sweep, result.num_nonfinite);
  }
  for (const Chosen& chosen : SortedChoice(sweep, num_kept)) {
    const LidarPoint& point = sweep.points[chosen.index];
    result.points.push_back({{point.x_m, point.y_m, point.z_m}, point.t_offset_ns});
  }
  result.to_match = SpreadIndices(result.points.size(), options_.match_points);
  voxel_m_ = AdaptedVoxel(options_, voxel_m_, num_kept);
  return result;
}

std::vector<std::uint32_t> SpreadIndices(std::size_t count, int wanted) {
  const double step = std::max(1.0, static_cast<double>(count) / wanted);
  std::vector<std::uint32_t> indices;
  indices.reserve(static_cast<std::size_t>(wanted) + 1);
  for (double at = 0.0; at < static_cast<double>(count); at += step) {
    indices.push_back(static_cast<std::uint32_t>(at));
  }
  return indices;
}

float AdaptedVoxel(const ReduceOptions& options, float voxel_m, std::size_t num_kept) {
  if (num_kept == 0) return voxel_m;
  // Points lie on surfaces, so their number goes with the inverse square of the edge.
  const double ratio = std::sqrt(static_cast<double>(num_kept) / options.target_points);
  const double wanted = voxel_m * std::clamp(ratio, 0.8, 1.25);
  return static_cast<float>(std::clamp(wanted, options.min_voxel_m, options.max_voxel_m));
}

}  // namespace lio
