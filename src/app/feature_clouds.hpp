// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Publishes the clouds LIO_CORNER_SHARP, LIO_CORNER_LESS_SHARP, LIO_SURF_FLAT, LIO_SURF_LESS_FLAT
// and LIO_REMOVED: the feature sets that LOAM's scan registration has extracted from a sweep, for
// viewers and for other programs.
#pragma once

#include <memory>
#include <vector>

#include "lio/io/input_decoder.hpp"
#include "lio/scan/loam_features.hpp"
#include "lio/scan/sweep.hpp"

namespace lio {

struct FeatureCloudTask {
  std::shared_ptr<const Sweep> sweep;
  std::shared_ptr<const LoamFeatures> features;  // extracted from the sweep
};

// Gives the points of a set as they were measured: in the lidar frame at each point's own instant,
// with the ring, which is rebuilt when the sweep has none. The chunks have at most kMaxChunkPoints
// points; an empty set has no chunk. The removed points are those at the border of a shadow and
// those at grazing incidence.
[[nodiscard]] std::vector<ScanChunk> FeatureCloud(const FeatureCloudTask& task, FeatureSet set);

}  // namespace lio
