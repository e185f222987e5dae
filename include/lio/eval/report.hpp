// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes an evaluation as text for people and as JSON for programs. The JSON's keys are a contract:
// docs/evaluation.md lists them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lio/eval/evaluation.hpp"

namespace lio {

struct ReportedFiles {
  std::string truth;
  std::string estimate;
};

[[nodiscard]] std::string EvaluationText(const Evaluation& evaluation, const ReportedFiles& files);
[[nodiscard]] nlohmann::ordered_json EvaluationJson(const Evaluation& evaluation,
                                                    const ReportedFiles& files);

// Returns the data that tools/plot/plot_trajectory.py draws: paths in the estimate's world, errors
// and heights over time.
[[nodiscard]] nlohmann::ordered_json PictureData(const Evaluation& evaluation,
                                                 const ReportedFiles& files);

}  // namespace lio
