// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes the pages of runs that are finished: of one, or of several side by side.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace lio {

// Returns the truth that the run was scored with: truth.tum in its folder, else the file that its
// eval.json names; nothing when neither is there.
[[nodiscard]] std::optional<std::filesystem::path> TruthOfRun(const std::filesystem::path& folder);

// Writes out/report.html with all runs, each compared with `truth` or else with its own. Throws
// UsageError when that page is there already and may not be replaced, and std::runtime_error as
// WriteReport does.
std::filesystem::path CompareRuns(const std::vector<std::filesystem::path>& folders,
                                  const std::optional<std::filesystem::path>& truth,
                                  const std::filesystem::path& out, bool overwrites);

}  // namespace lio
