// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Turns pipeline.method into the pair of parts that make it up.
#pragma once

#include <memory>
#include <vector>

#include "lio/pipeline/options.hpp"
#include "lio/registration/scan_matcher.hpp"
#include "lio/scan/reduced_scan.hpp"

namespace lio {

// `beam_elevations_rad`: of the lidar's model, lowest beam first; LOAM rebuilds missing rings by
// it.
std::unique_ptr<SweepReducer> MakeReducer(const Options& options,
                                          const std::vector<double>& beam_elevations_rad);

std::unique_ptr<ScanMatcher> MakeMatcher(const Options& options);

}  // namespace lio
