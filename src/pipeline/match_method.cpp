// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/match_method.hpp"

#include "lio/registration/gicp_matcher.hpp"
#include "lio/registration/loam_matcher.hpp"
#include "lio/registration/loam_scan_matcher.hpp"
#include "lio/registration/ndt_matcher.hpp"
#include "lio/scan/loam_reducer.hpp"
#include "lio/scan/reduce.hpp"

namespace lio {

std::unique_ptr<SweepReducer> MakeReducer(const Options& options,
                                          const std::vector<double>& beam_elevations_rad) {
  const LidarRig& lidar = options.rig.lidar;
  if (options.pipeline.method != MatchMethod::kLoam) {
    return std::make_unique<ScanReducer>(options.reduce, lidar);
  }
  return std::make_unique<LoamReducer>(options.loam_features, options.reduce, lidar,
                                       beam_elevations_rad);
}

std::unique_ptr<ScanMatcher> MakeMatcher(const Options& options) {
  switch (options.pipeline.method) {
    case MatchMethod::kLoam:
      if (options.loam.target == LoamTarget::kScan) {
        return std::make_unique<LoamScanMatcher>(options.loam);
      }
      return std::make_unique<LoamMatcher>(options.loam);
    case MatchMethod::kGicp:
      return std::make_unique<GicpMatcher>(options.gicp);
    case MatchMethod::kNdt:
      break;
  }
  return std::make_unique<NdtMatcher>(options.ndt, options.pipeline.num_threads);
}

}  // namespace lio
