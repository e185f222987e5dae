// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/feature_clouds.hpp"

#include <algorithm>

namespace lio {
namespace {

std::vector<std::uint32_t> IndicesOf(const LoamFeatures& features, FeatureSet set) {
  switch (set) {
    case FeatureSet::kCornerSharp:
      return features.sharp;
    case FeatureSet::kCornerLessSharp:
      return features.less_sharp;
    case FeatureSet::kSurfFlat:
      return features.flat;
    case FeatureSet::kSurfLessFlat:
      return features.less_flat;
    case FeatureSet::kRemoved:
      break;
  }
  std::vector<std::uint32_t> removed = features.occluded;
  removed.insert(removed.end(), features.grazed.begin(), features.grazed.end());
  std::sort(removed.begin(), removed.end());
  removed.erase(std::unique(removed.begin(), removed.end()), removed.end());
  return removed;
}

}  // namespace

std::vector<ScanChunk> FeatureCloud(const FeatureCloudTask& task, FeatureSet set) {
  const Sweep& sweep = *task.sweep;
  const std::vector<std::uint32_t> indices = IndicesOf(*task.features, set);
  const std::vector<std::uint16_t>& rebuilt = task.features->rebuilt_rings;
  const std::size_t num_chunks = (indices.size() + kMaxChunkPoints - 1) / kMaxChunkPoints;
  std::vector<ScanChunk> chunks(num_chunks);
  for (std::size_t i = 0; i < num_chunks; ++i) {
    chunks[i].stamp = sweep.start;
    chunks[i].scan_seq = sweep.scan_seq;
    chunks[i].chunk_index = static_cast<std::int16_t>(i);
    chunks[i].chunk_count = static_cast<std::int16_t>(num_chunks);
  }
  for (std::size_t i = 0; i < indices.size(); ++i) {
    LidarPoint point = sweep.points[indices[i]];
    if (!rebuilt.empty()) point.ring = rebuilt[indices[i]];
    chunks[i / kMaxChunkPoints].points.push_back(point);
  }
  return chunks;
}

}  // namespace lio
