// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds by how much the clocks of truth and estimate differ.
#pragma once

#include <optional>

#include "lio/eval/alignment.hpp"
#include "lio/eval/association.hpp"

namespace lio {

// Returns the estimate with `offset_s` added to its stamps.
[[nodiscard]] Trajectory Shifted(const Trajectory& estimate, double offset_s);

// Returns the offset within +-1 s that, added to the estimate's stamps, makes the position error
// after SE(3) alignment least; its tenth of a millisecond is searched for, its truth depends on the
// motion: a body at rest shows none. Throws std::runtime_error as Associate does, and for files
// without stamps.
[[nodiscard]] double FindTimeOffset(const Trajectory& truth, const Trajectory& estimate,
                                    std::optional<double> max_gap_s);

}  // namespace lio
