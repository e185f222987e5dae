// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/clock_step_doubt.hpp"

#include <utility>

namespace lio {

std::optional<ClockStep> ClockStepDoubt::stamps() const {
  return step_ ? std::optional(step_->stamps) : std::nullopt;
}

bool ClockStepDoubt::IsAbout(const Sweep& sweep) const {
  return step_ && sweep.middle() > step_->stamps.before;
}

std::optional<Pose> ClockStepDoubt::PoseIfSet(const Sweep& sweep, const Pose& T_map_imu_predicted,
                                              const std::optional<Timestamp>& last_located,
                                              const FilterHistory& history) const {
  if (!IsAbout(sweep)) return std::nullopt;
  const auto& [stamps, T_map_before] = *step_;
  if (last_located && *last_located > stamps.before) return std::nullopt;
  const Pose before = T_map_before ? *T_map_before : history.At(stamps.before).state.T_map_imu;
  return before * (history.At(stamps.after).state.T_map_imu.Inverse() * T_map_imu_predicted);
}

std::optional<ClockStep> ClockStepDoubt::Settle(const MatchOutcome& outcome) {
  if (!IsAbout(*outcome.sweep)) return std::nullopt;
  const Step step = *std::exchange(step_, std::nullopt);
  return outcome.is_clock_set ? std::optional(step.stamps) : std::nullopt;
}

}  // namespace lio
