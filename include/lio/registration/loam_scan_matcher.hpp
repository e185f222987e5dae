// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// LOAM's scan-to-scan matching: sharp edge points against lines through two edge points of the scan
// before, on neighbouring rings; flat ones against planes through three of its surface points, two
// of a ring and one of another. The map is the scan that was inserted last, so poses drift as
// odometry does.
//
// A scan that is not deskewed can be given with each point's sweep ratio, its share 0..1 of the
// sweep's time: the pose is then the motion during one sweep, of which each point has seen that
// part, as in the original.
// Source: Zhang and Singh, "LOAM", RSS 2014, section V; A-LOAM's choice of neighbours.
#pragma once

#include <memory>

#include "lio/registration/loam_options.hpp"
#include "lio/registration/match_diagnostics.hpp"
#include "lio/registration/match_summary.hpp"
#include "lio/registration/scan_matcher.hpp"
#include "lio/registration/search_radius.hpp"

namespace lio {

class LoamTerms;
class RingGrid;

class LoamScanMatcher final : public ScanMatcher, public MatchDiagnostics {
 public:
  explicit LoamScanMatcher(const LoamOptions& options);
  ~LoamScanMatcher() override;

  MatchResult Match(const MatchInput& input) override;
  // Matches a scan that is not deskewed. `sweep_ratios` has one for each point of the input.
  MatchResult MatchSkewed(const MatchInput& input, std::span<const float> sweep_ratios);
  void Insert(const ScanView& scan, const Pose& T_map_imu) override;
  void Clear() override;
  MapSize map_size() const override;
  double FixedCorrespondenceCost(const MatchInput& input, const Pose& T_map_imu) const override;

 private:
  void Associate(const MatchInput& input, std::span<const float> sweep_ratios,
                 const Pose& T_last_imu, const SearchRadius& radius);
  void AddEdge(std::int32_t number, const Eigen::Vector3f& place, float search_m);
  void AddPlane(std::int32_t number, const Eigen::Vector3f& place, float search_m);
  void Finish(const MatchInput& input, std::span<const float> sweep_ratios, const Pose& T_last_imu,
              MatchResult& result);

  LoamOptions options_;
  Pose T_map_last_;  // the pose of the last scan
  std::unique_ptr<RingGrid> edges_;
  std::unique_ptr<RingGrid> surfaces_;
  std::unique_ptr<LoamTerms> terms_;  // in the current round
  MatchScores scores_;                // by part, the edges' after the surfaces'
};

}  // namespace lio
