// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Thins a sweep: drops what is not finite, too near, too far or the vehicle itself, and keeps one
// point a voxel, the one nearest the voxel's centre, whatever order the points come in.
#pragma once

#include <cstdint>
#include <vector>

#include "lio/scan/point_filter.hpp"
#include "lio/scan/reduce_options.hpp"
#include "lio/scan/reduced_scan.hpp"
#include "lio/sensor/rig.hpp"

namespace lio {

class ScanReducer final : public SweepReducer {
 public:
  ScanReducer(const ReduceOptions& options, const LidarRig& rig);

  // Adapts the voxel edge for the next call to options.target_points. Cost: linear; no allocation
  // once warm but the result.
  ReducedScan Reduce(const Sweep& sweep) override;

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t epoch = 0;
    std::uint32_t index = 0;  // of the chosen point in the sweep
    float distance_sq = 0.f;  // of it from the voxel's centre, in voxels
  };
  struct Chosen {
    std::uint64_t key = 0;  // time, then ring
    std::uint32_t index = 0;
  };
  static constexpr std::size_t kTableFull = static_cast<std::size_t>(-1);

  // Gives the number of voxels hit, or kTableFull.
  std::size_t FillSlots(const Sweep& sweep, int& num_nonfinite);
  std::vector<Chosen> SortedChoice(const Sweep& sweep, std::size_t num_kept) const;

  ReduceOptions options_;
  PointFilter filter_;
  float voxel_m_;
  std::uint32_t epoch_ = 0;
  std::vector<Slot> slots_;  // open addressing, a power of two; slots of older epochs are free
};

}  // namespace lio
