// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Converts the errors of a lidar's beams between the rig, which lists them kind by kind, and the
// calibration, which has them ring by ring.
#pragma once

#include <optional>

#include "lio/sensor/beam_errors.hpp"
#include "lio/sensor/rig.hpp"

namespace lio {

// Returns no rings where the rig has no beams. The lists must be as long as Validate demands.
[[nodiscard]] BeamKnowledge KnownBeams(const LidarRig& rig);

// Returns nothing where nothing is known.
[[nodiscard]] std::optional<LidarBeams> AsLidarBeams(const BeamKnowledge& known);

}  // namespace lio
