// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Thins a sweep: drops points that are not finite, too near, too far or the vehicle itself, and
// keeps one point per voxel, the nearest to the voxel's centre. The order of the points does not
// matter. Lidar frame, metres. Nothing throws.
#pragma once

#include <cstdint>
#include <vector>

#include "lio/base/voxel_table.hpp"
#include "lio/scan/mixed_pixels.hpp"
#include "lio/scan/point_filter.hpp"
#include "lio/scan/range_noise.hpp"
#include "lio/scan/reduce_options.hpp"
#include "lio/scan/reduced_scan.hpp"
#include "lio/sensor/rig.hpp"

namespace lio {

class ScanReducer final : public SweepReducer {
 public:
  ScanReducer(const ReduceOptions& options, const LidarRig& rig);

  // Adapts the voxel edge for the next call to options.target_points. The cost is linear; after the
  // first calls only the result is allocated.
  ReducedScan Reduce(const Sweep& sweep) override;

 private:
  // Holds the point chosen for a voxel: its distance from the voxel's centre, squared and in
  // voxels, as a float's bits, which order as it does; below them its index in the sweep.
  using Choice = std::uint64_t;
  struct Chosen {
    std::uint64_t key = 0;  // time, then ring
    std::uint32_t index = 0;
  };

  void FindCandidates(const Sweep& sweep, int& num_nonfinite);
  void ChoosePoints(const Sweep& sweep);
  void MarkChosen();
  std::vector<Chosen> SortedChoice(const Sweep& sweep);

  ReduceOptions options_;
  PointFilter filter_;
  MixedPixelFinder mixed_pixels_;
  RangeNoiseEstimator range_noise_;
  float voxel_m_;
  std::vector<std::uint32_t> candidates_;  // indices of the finite, sampled points in range
  VoxelTable<Choice> choices_;             // by voxel
  std::vector<std::uint64_t> is_chosen_;   // one bit per point of the sweep
};

}  // namespace lio
