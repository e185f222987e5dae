// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/scored_run.hpp"

#include "lio/eval/time_offset.hpp"
#include "lio/io/file_kind.hpp"

namespace lio {

ScoredRun ScoreTrajectory(const Trajectory& truth, const Trajectory& estimate,
                          const EvaluationOptions& options, const TimeOffsetWish& wish) {
  ScoredRun scored;
  scored.time_offset_s =
      wish.is_automatic ? FindTimeOffset(truth, estimate, options.max_gap_s) : wish.offset_s;
  scored.evaluation = Evaluate(truth, Shifted(estimate, scored.time_offset_s), options);
  return scored;
}

ScoredRun ScoreRun(const Trajectory& truth, const std::string& run,
                   const EvaluationOptions& options, const TimeOffsetWish& wish) {
  const std::string file = KindOf(run) == FileKind::kRunFolder ? PathOfRun(run).string() : run;
  ScoredRun scored = ScoreTrajectory(truth, ReadTrajectory(file), options, wish);
  scored.name = run;
  scored.file = file;
  return scored;
}

}  // namespace lio
