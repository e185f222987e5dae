// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/loam_reducer.hpp"

#include <algorithm>
#include <utility>

#include "lio/scan/point_filter.hpp"
#include "scan/scan_parameters.hpp"

namespace lio {
namespace {

void Append(const Sweep& sweep, const LoamFeatures& features, std::uint32_t i, FeatureKind kind,
            ReducedScan& result) {
  const LidarPoint& point = sweep.points[i];
  result.points.push_back({{point.x_m, point.y_m, point.z_m}, point.t_offset_ns, point.ring});
  result.tags.push_back(
      {kind, features.rebuilt_rings.empty() ? point.ring : features.rebuilt_rings[i]});
}

}  // namespace

LoamReducer::LoamReducer(const LoamFeatureOptions& features, const ReduceOptions& reduce,
                         const LidarRig& rig, std::vector<double> beam_elevations_rad)
    : feature_options_(features),
      options_(reduce),
      rig_(rig),
      beam_elevations_rad_(std::move(beam_elevations_rad)),
      voxel_m_(static_cast<float>(reduce.voxel_m)) {}

void LoamReducer::AddEdges(const Sweep& sweep, const LoamFeatures& features, ReducedScan& result) {
  // Both lists have the same order; less_sharp includes the sharp points.
  std::size_t next_sharp = 0;
  for (const std::uint32_t i : features.less_sharp) {
    const bool is_sharp = next_sharp < features.sharp.size() && features.sharp[next_sharp] == i;
    if (is_sharp) ++next_sharp;
    Append(sweep, features, i, is_sharp ? FeatureKind::kSharp : FeatureKind::kLessSharp, result);
  }
}

void LoamReducer::AddSurfaces(const Sweep& sweep, const LoamFeatures& features,
                              ReducedScan& result) {
  voxels_.Clear();
  const float inverse_voxel = 1.f / voxel_m_;
  const auto add = [&](std::uint32_t i, FeatureKind kind) {
    const LidarPoint& point = sweep.points[i];
    const bool is_new = voxels_.Insert(PackVoxel(FloorToInt(point.x_m * inverse_voxel),
                                                 FloorToInt(point.y_m * inverse_voxel),
                                                 FloorToInt(point.z_m * inverse_voxel)));
    if (is_new) Append(sweep, features, i, kind, result);
  };
  for (const std::uint32_t i : features.flat) add(i, FeatureKind::kFlat);
  for (const std::uint32_t i : features.less_flat) add(i, FeatureKind::kLessFlat);
  voxel_m_ = AdaptedVoxel(options_, voxel_m_, voxels_.size());
}

ReducedScan LoamReducer::Reduce(const Sweep& sweep) {
  ReducedScan result;
  result.num_nonfinite = static_cast<int>(std::count_if(
      sweep.points.begin(), sweep.points.end(), [](const auto& p) { return !IsFinite(p); }));
  result.voxel_m = voxel_m_;
  auto features = std::make_shared<LoamFeatures>(
      ExtractLoamFeatures(sweep, feature_options_, rig_, beam_elevations_rad_));
  AddEdges(sweep, *features, result);
  const std::size_t num_edges = result.points.size();
  AddSurfaces(sweep, *features, result);
  const int max_edges = options_.match_points / kScanParameters.loam.edge_divisor;
  const int num_matched_edges = std::min(static_cast<int>(num_edges), max_edges);
  result.to_match = SpreadIndices(num_edges, std::max(num_matched_edges, 1));
  for (const std::uint32_t i :
       SpreadIndices(result.points.size() - num_edges, options_.match_points - num_matched_edges)) {
    result.to_match.push_back(static_cast<std::uint32_t>(num_edges) + i);
  }
  result.features = std::move(features);
  return result;
}

}  // namespace lio
