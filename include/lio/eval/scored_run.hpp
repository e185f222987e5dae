// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Scores a path, also of a file or of a run's folder, against a truth.
#pragma once

#include <string>

#include "lio/eval/evaluation.hpp"

namespace lio {

// Says by how much the estimate's clock is set before it is scored.
struct TimeOffsetWish {
  bool is_automatic = false;
  double offset_s = 0.0;  // added to the estimate's stamps
};

struct ScoredRun {
  std::string name;  // as the user gave it; empty where there is no file
  std::string file;  // the trajectory that was scored; likewise
  double time_offset_s = 0.0;
  Evaluation evaluation;
};

// Shifts the estimate as wished, and scores it. Throws std::runtime_error as Evaluate does.
[[nodiscard]] ScoredRun ScoreTrajectory(const Trajectory& truth, const Trajectory& estimate,
                                        const EvaluationOptions& options,
                                        const TimeOffsetWish& wish);

// Reads the trajectory of a file or of a run's folder, shifts it as wished, and scores it. Throws
// std::runtime_error that names the file.
[[nodiscard]] ScoredRun ScoreRun(const Trajectory& truth, const std::string& run,
                                 const EvaluationOptions& options, const TimeOffsetWish& wish);

}  // namespace lio
