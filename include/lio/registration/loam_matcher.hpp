// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// LOAM's scan-to-map matching: edge points against lines through their neighbours on an edge map,
// surface points against planes through theirs on a surface map, with Huber's loss. Each round
// seeks the correspondences anew and makes Gauss-Newton steps, until the pose stands still.
//
// It needs points with tags (scan/feature_tag.hpp). Correspondences are sought as far as the guess
// may be off and the maps are coarse. The cost is in units of the surface points' variance.
// Differences from A-LOAM: maps are running means in hashed voxels and not re-filtered clouds with
// k-d trees built anew; planes whose points spread along one ring only do not count; an edge point
// weighs as much as it is accurate; degenerate directions get no step.
// Source: Zhang and Singh, "LOAM", RSS 2014, sections V-B and VI.
#pragma once

#include <memory>

#include "lio/map/point_map.hpp"
#include "lio/registration/loam_options.hpp"
#include "lio/registration/match_diagnostics.hpp"
#include "lio/registration/match_summary.hpp"
#include "lio/registration/scan_matcher.hpp"
#include "lio/registration/search_radius.hpp"

namespace lio {

class LoamTerms;

class LoamMatcher final : public ScanMatcher, public MatchDiagnostics {
 public:
  explicit LoamMatcher(const LoamOptions& options);
  ~LoamMatcher() override;

  MatchResult Match(const MatchInput& input) override;
  void Insert(const ScanView& scan, const Pose& T_map_imu) override;
  void Clear() override;
  MapSize map_size() const override;
  double FixedCorrespondenceCost(const MatchInput& input, const Pose& T_map_imu) const override;

 private:
  void Associate(const MatchInput& input, const Pose& T_map_imu, const SearchRadius& radius);
  // Returns the pose after Gauss-Newton steps with the correspondences of one round.
  Pose SolveRound(const MatchInput& input, Pose T_map_imu);
  double NewContentShare(const MatchInput& input, const Pose& T_map_imu) const;
  void Finish(const MatchInput& input, const Pose& T_map_imu, MatchResult& result);

  LoamOptions options_;
  PointMap edge_map_;
  PointMap surface_map_;
  std::unique_ptr<LoamTerms> terms_;  // in the current round
  MatchScores scores_;                // by block, the edge map's after the surface map's
};

}  // namespace lio
