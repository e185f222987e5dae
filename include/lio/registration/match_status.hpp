// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// How a match of a scan against the map ended.
#pragma once

#include <cstdint>

namespace lio {

enum class MatchStatus : std::int8_t {
  kConverged = 0,
  kMaxIterations = 1,
  kTooFewPoints = 2,
  kEmptyMap = 3,  // nothing to match against yet: the scan starts the map
  kDiverged = 4,
  kDegenerate = 5,  // converged, with degenerate directions
};

}  // namespace lio
