// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/reduce.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "scan/sampling.hpp"

namespace lio {
namespace {

constexpr std::uint32_t kBitsPerWord = 64;
constexpr ThinningParameters kThinning = kScanParameters.thinning;

struct Voxel {
  VoxelKey key;
  float distance_sq;  // from the point to the voxel's centre, in voxels
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

std::uint32_t IndexOf(std::uint64_t choice) {
  return static_cast<std::uint32_t>(choice);
}

}  // namespace

ScanReducer::ScanReducer(const ReduceOptions& options, const LidarRig& rig)
    : options_(options),
      filter_(rig),
      voxel_m_(static_cast<float>(options.voxel_m)),
      choices_(kThinning.initial_slots) {}

// Nothing branches on whether a point is used, because branch prediction would fail.
void ScanReducer::FindCandidates(const Sweep& sweep, int& num_nonfinite) {
  const std::uint32_t share = SampleShare(sweep.points.size());
  candidates_.resize(sweep.points.size());
  std::size_t num_candidates = 0;
  num_nonfinite = 0;
  for (std::uint32_t i = 0; i < sweep.points.size(); ++i) {
    const LidarPoint& point = sweep.points[i];
    const bool is_finite = IsFinite(point);
    const bool is_sampled = Sample(point) < share;
    const bool is_in_range = filter_.IsInRange(point);
    num_nonfinite += is_finite ? 0 : 1;
    candidates_[num_candidates] = i;
    num_candidates += static_cast<std::size_t>(is_finite & is_sampled & is_in_range);
  }
  candidates_.resize(num_candidates);
}

void ScanReducer::ChoosePoints(const Sweep& sweep) {
  choices_.Clear();
  const float inverse_voxel = 1.0f / voxel_m_;
  for (const std::uint32_t i : candidates_) {
    const LidarPoint& point = sweep.points[i];
    if (filter_.IsOwnVehicle(point)) continue;
    const Voxel voxel = VoxelOf(point, inverse_voxel);
    const std::uint64_t distance = std::bit_cast<std::uint32_t>(voxel.distance_sq);
    const std::uint64_t choice = distance << 32 | i;
    const auto [chosen, is_new] = choices_.FindOrAdd(voxel.key);
    if (is_new) {
      chosen = choice;
    } else if (chosen >> 32 == distance) [[unlikely]] {
      if (Precedes(point, sweep.points[IndexOf(chosen)])) chosen = choice;
    } else {
      chosen = std::min(chosen, choice);
    }
  }
}

// Marks the chosen points in the sweep's order, which mostly is the order that SortedChoice needs.
void ScanReducer::MarkChosen() {
  is_chosen_.assign((candidates_.empty() ? 0 : candidates_.back() / kBitsPerWord) + 1, 0);
  choices_.ForEachInAnyOrder([&](std::uint64_t choice) {
    const std::uint32_t index = IndexOf(choice);
    is_chosen_[index / kBitsPerWord] |= std::uint64_t{1} << (index % kBitsPerWord);
  });
}

// Returns the chosen points by time, then ring. A key beside the index saves the sort from reading
// the points.
std::vector<ScanReducer::Chosen> ScanReducer::SortedChoice(const Sweep& sweep) {
  MarkChosen();
  std::vector<Chosen> chosen;
  chosen.reserve(choices_.size());
  for (std::uint32_t word = 0; word < is_chosen_.size(); ++word) {
    for (std::uint64_t bits = is_chosen_[word]; bits != 0; bits &= bits - 1) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(bits));
      const std::uint32_t index = word * kBitsPerWord + bit;
      const LidarPoint& point = sweep.points[index];
      chosen.push_back({(std::uint64_t{point.t_offset_ns} << 16) | point.ring, index});
    }
  }
  const auto precedes = [&](const Chosen& a, const Chosen& b) {
    return a.key != b.key ? a.key < b.key : Precedes(sweep.points[a.index], sweep.points[b.index]);
  };
  if (!std::is_sorted(chosen.begin(), chosen.end(), precedes)) {
    std::sort(chosen.begin(), chosen.end(), precedes);
  }
  return chosen;
}

ReducedScan ScanReducer::Reduce(const Sweep& sweep) {
  ReducedScan result;
  result.voxel_m = voxel_m_;
  FindCandidates(sweep, result.num_nonfinite);
  ChoosePoints(sweep);
  result.points.reserve(choices_.size());
  mixed_pixels_.Load(sweep);
  range_noise_.Add(mixed_pixels_, sweep.points.size());
  result.range_std_m = range_noise_.std_m();
  for (const Chosen& chosen : SortedChoice(sweep)) {
    if (mixed_pixels_.IsMixed(chosen.index)) continue;
    const LidarPoint& point = sweep.points[chosen.index];
    result.points.push_back({{point.x_m, point.y_m, point.z_m}, point.t_offset_ns, point.ring});
  }
  result.to_match = SpreadIndices(result.points.size(), options_.match_points);
  voxel_m_ = AdaptedVoxel(options_, voxel_m_, choices_.size());
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
  // Points lie on surfaces, so their number is proportional to the inverse square of the edge.
  const double ratio = std::sqrt(static_cast<double>(num_kept) / options.target_points);
  const double wanted =
      voxel_m * std::clamp(ratio, kThinning.min_edge_ratio, kThinning.max_edge_ratio);
  return static_cast<float>(std::clamp(wanted, options.min_voxel_m, options.max_voxel_m));
}

}  // namespace lio
