// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Thins a sweep: drops points that are not finite, too near, too far or the vehicle itself, and
// keeps one point per voxel, the nearest to the voxel's centre. The order of the points does not
// matter. Lidar frame, metres. Nothing throws.
#pragma once

#include <cstdint>
#include <vector>

#include "lio/base/voxel_key.hpp"
#include "lio/scan/point_filter.hpp"
#include "lio/scan/reduce_options.hpp"
#include "lio/scan/reduced_scan.hpp"
#include "lio/sensor/rig.hpp"

namespace lio {

class ScanReducer final : public SweepReducer {
 public:
  ScanReducer(const ReduceOptions& options, const LidarRig& rig);

  // Adapts the voxel edge for the next call to options.target_points. Cost: linear; after the
  // first calls only the result is allocated.
  ReducedScan Reduce(const Sweep& sweep) override;

 private:
  struct Slot {
    VoxelKey key = kFreeSlot;
    // The chosen point. Upper half: its squared distance from the voxel's centre in voxels, as the
    // bits of a float, whose order is the same. Lower half: its index in the sweep.
    std::uint64_t choice = 0;
  };
  struct Chosen {
    std::uint64_t key = 0;  // time, then ring
    std::uint32_t index = 0;
  };
  static constexpr std::size_t kTableFull = static_cast<std::size_t>(-1);
  static constexpr VoxelKey kFreeSlot =
      ~VoxelKey{0};  // not a voxel's key, which leaves the top bit free

  void FindCandidates(const Sweep& sweep, int& num_nonfinite);
  // Returns the number of occupied voxels, or kTableFull.
  std::size_t FillSlots(const Sweep& sweep);
  void MarkChosen();
  std::vector<Chosen> SortedChoice(const Sweep& sweep, std::size_t num_kept);

  ReduceOptions options_;
  PointFilter filter_;
  float voxel_m_;
  std::vector<std::uint32_t> candidates_;  // indices of the finite, sampled points in range
  std::vector<Slot> slots_;                // open addressing, a power of two
  std::vector<std::uint64_t> is_chosen_;   // one bit per point of the sweep
};

}  // namespace lio
