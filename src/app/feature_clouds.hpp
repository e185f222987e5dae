// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// LIO_CORNER_SHARP, LIO_CORNER_LESS_SHARP, LIO_SURF_FLAT, LIO_SURF_LESS_FLAT, LIO_REMOVED: the sets
// that LOAM's scan registration has made of a sweep, for eyes and for other programs.
#pragma once

#include <memory>
#include <vector>

#include "lio/io/input_decoder.hpp"
#include "lio/scan/loam_features.hpp"
#include "lio/scan/sweep.hpp"

namespace lio {

struct FeatureCloudTask {
  std::shared_ptr<const Sweep> sweep;
  std::shared_ptr<const LoamFeatures> features;  // of the sweep
};

// The set's points as they were measured: lidar frame at each one's own instant, with ring, rebuilt
// where the sweep had none. Chunks of at most kMaxChunkPoints; none of an empty set. The removed
// ones are those at the border of a shadow and those on surfaces nearly parallel to the beam.
std::vector<ScanChunk> FeatureCloud(const FeatureCloudTask& task, FeatureSet set);

}  // namespace lio
