// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The stamps of all sensors went forward, and it is open whether time passed meanwhile or the
// clocks were set. The first sweep after the step that is located settles it: matching is told the
// pose that the body has if no time passed, and says which of the two it found.
#pragma once

#include <optional>

#include "lio/filter/filter_history.hpp"
#include "lio/pipeline/match_job.hpp"
#include "lio/stream/clock_step_arbiter.hpp"

namespace lio {

class ClockStepDoubt {
 public:
  // Takes a step that the filter's history reaches across.
  void Begin(const ClockStep& stamps) { step_ = {stamps, std::nullopt}; }
  // Takes a step after which the history begins anew; the body was there before it.
  void Begin(const ClockStep& stamps, const Pose& T_map_imu) { step_ = {stamps, T_map_imu}; }
  void End() { step_.reset(); }

  // Returns the step in doubt, if there is one; tests ask for it.
  [[nodiscard]] std::optional<ClockStep> stamps() const;
  [[nodiscard]] bool IsAbout(const Sweep& sweep) const;  // it is after the step
  // Returns the pose of a sweep after the step if no time passed there: the motion since the step
  // is added to the pose before it. It is absent without a doubt, and where a sweep has been
  // located meanwhile.
  [[nodiscard]] std::optional<Pose> PoseIfSet(const Sweep& sweep, const Pose& T_map_imu_predicted,
                                              const std::optional<Timestamp>& last_located,
                                              const FilterHistory& history) const;
  // A sweep was located. Gives the step where that has shown that the clocks were set.
  [[nodiscard]] std::optional<ClockStep> Settle(const MatchOutcome& outcome);

 private:
  struct Step {
    ClockStep stamps;
    std::optional<Pose> T_map_imu_before;  // absent: the filter's history has it
  };
  std::optional<Step> step_;
};

}  // namespace lio
