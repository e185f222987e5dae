// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Defines the mode of the estimator. To build a mode is the reset; what it begins with comes by the
// transition that asked for it (transition.hpp has the table).
#pragma once

#include <variant>

#include "pipeline/initializing.hpp"
#include "pipeline/lidar_only.hpp"
#include "pipeline/tracking.hpp"

namespace lio {

// The configuration contradicts the data: all that follows is ignored.
struct Rejected {
  std::size_t next_sweep() const { return 0; }
  TrackingStatus status() const { return TrackingStatus::kInit; }
};

using Mode = std::variant<Initializing, Tracking, LidarOnly, Rejected>;

ModeKind KindOf(const Mode& mode);
TrackingStatus StatusOf(const Mode& mode);
// Returns the index of the sweep to match next in the queue of those that wait.
std::size_t NextSweepOf(const Mode& mode);

// Returns the rule of the table, which is counted where the table calls it a restart: all restarts
// are counted here, but for those that Odometry::Reset is asked for. Throws std::logic_error where
// the table has no rule.
TransitionRule TakeRule(ModeKind from, Trigger trigger, Counters& counters);

// Builds the mode that the rule names.
[[nodiscard]] Mode BuildNext(const Mode& mode, Transition transition, const ModeContext& context);

}  // namespace lio
