// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tells how a match of a scan against the map ended.
#pragma once

#include <array>
#include <cstdint>

#include "lio/map/ndt_options.hpp"

namespace lio {

enum class MatchStatus : std::int8_t {
  kConverged = 0,
  kMaxIterations = 1,
  kTooFewPoints = 2,
  kEmptyMap = 3,  // nothing to match against yet: the scan starts the map
  kDiverged = 4,
  kDegenerate = 5,  // converged, with degenerate directions
};

// Counts for each level of NdtMatcher's map, finest first, whichever are in use: cells of level i
// have an edge of voxel_m / 2^(num_levels - i), by default 0.25, 0.5, 1 and 2 m.
using LevelCounts = std::array<int, kMaxMapLevels + kNumFinerLevels + kNumCoarserLevels>;

}  // namespace lio
