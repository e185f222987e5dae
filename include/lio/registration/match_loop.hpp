// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The loop that every matcher runs: step by step from the guess, with a reach that shrinks, until
// the reach is used up and a step is small.
#pragma once

#include <optional>

#include "lio/registration/scan_matcher.hpp"

namespace lio {

struct StopRule {
  int max_steps = 1;
  double small_step_m = 0.0;  // a step smaller than both of these ends the loop
  double small_step_rad = 0.0;

  bool IsSmall(const Vector6& step) const {
    return step.head<3>().norm() < small_step_m && step.tail<3>().norm() < small_step_rad;
  }
};

// Moves `pose` by `step_at(pose, reach)`, a right increment, or nothing where too little of the
// scan is matched, which ends the loop. `reach` has IsExhausted() and Shrink(). Fills the result's
// iterations and status; false where a step was no number: then the result is complete.
template <class Reach, class StepAt>
bool StepUntilStill(const StopRule& rule, Reach reach, const StepAt& step_at, Pose& pose,
                    MatchResult& result) {
  result.status = MatchStatus::kMaxIterations;
  while (result.iterations < rule.max_steps) {
    ++result.iterations;
    const std::optional<Vector6> step = step_at(pose, reach);
    if (!step) break;
    if (!step->allFinite()) {
      result.status = MatchStatus::kDiverged;
      return false;
    }
    pose = pose * ExpSe3(*step);
    if (reach.IsExhausted() && rule.IsSmall(*step)) {
      result.status = MatchStatus::kConverged;
      break;
    }
    reach.Shrink();
  }
  return true;
}

}  // namespace lio
