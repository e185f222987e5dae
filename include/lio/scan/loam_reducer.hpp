// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reduces a sweep for LOAM: all edge points, and surface points thinned to about the target number,
// the flattest first. Points are in the lidar frame, metres, each at its own instant.
#pragma once

#include <vector>

#include "lio/base/voxel_set.hpp"
#include "lio/scan/loam_feature_options.hpp"
#include "lio/scan/reduce_options.hpp"
#include "lio/scan/reduced_scan.hpp"
#include "lio/sensor/rig.hpp"

namespace lio {

class LoamReducer final : public SweepReducer {
 public:
  // `beam_elevations_rad` are those of the lidar's model, lowest first, for sweeps without rings.
  LoamReducer(const LoamFeatureOptions& features, const ReduceOptions& reduce, const LidarRig& rig,
              std::vector<double> beam_elevations_rad);

  ReducedScan Reduce(const Sweep& sweep) override;

 private:
  void AddEdges(const Sweep& sweep, const LoamFeatures& features, ReducedScan& result);
  void AddSurfaces(const Sweep& sweep, const LoamFeatures& features, ReducedScan& result);

  LoamFeatureOptions feature_options_;
  ReduceOptions options_;
  LidarRig rig_;
  std::vector<double> beam_elevations_rad_;
  float voxel_m_;
  VoxelSet voxels_;
};

}  // namespace lio
