// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Scores several runs against one truth, in one table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lio/eval/evaluation.hpp"

namespace lio {

// Holds the words of --time-offset.
struct TimeOffsetWish {
  bool is_automatic = false;
  double offset_s = 0.0;  // added to the estimate's stamps
};

struct ScoredRun {
  std::string name;  // as the user gave it
  std::string file;  // the trajectory that was scored
  double time_offset_s = 0.0;
  Evaluation evaluation;
};

// Reads the trajectory of a file or of a run's folder, shifts it as wished, and scores it. Throws
// std::runtime_error that names the file.
[[nodiscard]] ScoredRun ScoreRun(const Trajectory& truth, const std::string& run,
                                 const EvaluationOptions& options, const TimeOffsetWish& wish);

// Returns the table for people, and the same rows with commas.
[[nodiscard]] std::string ComparisonText(const std::vector<ScoredRun>& runs);
[[nodiscard]] std::string ComparisonCsv(const std::vector<ScoredRun>& runs);

}  // namespace lio
