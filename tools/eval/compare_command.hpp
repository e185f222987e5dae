// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Shows several runs that were scored against one truth, in one table.
#pragma once

#include <string>
#include <vector>

#include "lio/eval/scored_run.hpp"

namespace lio {

// Returns the table for people, and the same rows with commas.
[[nodiscard]] std::string ComparisonText(const std::vector<ScoredRun>& runs);
[[nodiscard]] std::string ComparisonCsv(const std::vector<ScoredRun>& runs);

}  // namespace lio
