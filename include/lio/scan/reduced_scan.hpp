// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Defines the points that a registration method uses of a sweep, and the interface of reducers: one
// per method.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lio/scan/feature_tag.hpp"
#include "lio/scan/loam_features.hpp"
#include "lio/scan/reduce_options.hpp"
#include "lio/scan/sweep.hpp"

namespace lio {

// Holds a return that will be used: lidar frame at its own instant.
struct ScanPoint {
  Eigen::Vector3f position;       // m
  std::uint32_t t_offset_ns = 0;  // after the sweep's start
  std::uint16_t ring = 0;         // 0 is the lowest beam
};

struct ReducedScan {
  std::vector<ScanPoint> points;                 // inserted into the map
  std::vector<FeatureTag> tags;                  // one per point; empty when the method needs none
  std::vector<std::uint32_t> to_match;           // indices of the points that are matched
  std::shared_ptr<const LoamFeatures> features;  // LOAM only
  int num_nonfinite = 0;
  float range_std_m = 0;  // noise of the ranges, as the sweeps so far show it; 0: not known
  float voxel_m = 0;      // the edge of the thinning grid that was used; only tests read it
};

class SweepReducer {
 public:
  virtual ~SweepReducer() = default;
  // Adapts its thinning from call to call: results depend on earlier sweeps and on nothing else.
  virtual ReducedScan Reduce(const Sweep& sweep) = 0;
};

// Returns the edge of the thinning grid for the next sweep, m, when this one kept `num_kept`
// points.
float AdaptedVoxel(const ReduceOptions& options, float voxel_m, std::size_t num_kept);

// Returns about `wanted` of the indices below `count`, evenly spread and ascending; all when fewer.
std::vector<std::uint32_t> SpreadIndices(std::size_t count, int wanted);

}  // namespace lio
