// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs the mode of initialization alone along a motion.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "pipeline/initializing.hpp"
#include "pipeline/mode_bench.hpp"

namespace lio::test {

inline constexpr double kDriveFrom_s = 6.0;  // WindingDrive() has its full speed of 8 m/s by then

struct InitializingBench {
  explicit InitializingBench(const Options& options = {}, Handover handover = {})
      : bench(options),
        mode(std::make_unique<Initializing>(bench.context(), std::move(handover))) {}

  void BeginAgain(const Transition& retry) {
    mode =
        std::make_unique<Initializing>(bench.context(), retry.handover, retry.initializing_since);
  }

  // Matches all sweeps that wait, or those up to the first transition.
  std::optional<Transition> MatchWaiting(const Motion& motion) {
    while (mode->next_sweep() < bench.sweeps.size()) {
      const MatchJob job = mode->MakeJob(bench.sweeps[mode->next_sweep()]);
      InsertTask insert;
      MatchOutcome outcome = bench.Matched(job, motion);
      outcome.match.cov += unseen_cov;
      outcome.speed_by_buildings = speed_by_buildings;
      if (auto transition = mode->FinishJob(outcome, insert)) return transition;
    }
    return std::nullopt;
  }

  // Feeds sweeps without a break from `from_s` to `to_s`, and the inertial samples that cover them.
  // Ends with the first transition.
  std::optional<Transition> Drive(const Motion& motion, double from_s, double to_s) {
    for (double start_s = from_s; start_s < to_s - 0.5 * kSweepSpan_s; start_s += kSweepSpan_s) {
      bench.FeedImu(motion, start_s, start_s + kSweepSpan_s);
      bench.AddSweep(start_s);
      if (auto transition = MatchWaiting(motion)) return transition;
    }
    return std::nullopt;
  }

  std::optional<SpeedRange> speed_by_buildings;  // the search for a velocity finds this
  Matrix6 unseen_cov = Matrix6::Zero();          // adds to the matches', right error
  ModeBench bench;
  std::unique_ptr<Initializing> mode;
};

// Stands at the origin with the imu rolled by 0.1 rad.
inline Motion Leaning() {
  return [](double) { return Pose{ExpSo3(Vector3(0.1, 0, 0)), Vector3::Zero()}; };
}

}  // namespace lio::test
