// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Scores a finished run and writes its page.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "lio/report/run_report.hpp"
#include "lio/verdict/verdict.hpp"

namespace lio {

struct Score {
  std::string line;        // for users, e.g. "position error 0.004 m rmse, ..."
  bool is_scored = false;  // otherwise `line` says why not
};

// Compares the path with the truth; writes folder/eval.json and folder/eval.txt. Does not throw for
// a truth that cannot be compared. Throws OutputError for a file that cannot be written.
[[nodiscard]] Score ScoreRun(const std::filesystem::path& folder,
                             const std::filesystem::path& truth);

// Writes folder/rig_corrected.yaml: the rig of `files` with the lines that the verdict's likeliest
// cause with a fix proposes. Returns its path; nothing where no cause has a fix.
[[nodiscard]] std::optional<std::filesystem::path> WriteCorrectedRig(
    const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files,
    const Verdict& verdict);

// Removes what an earlier run of lio-run may have left in `folder`, except for `kept`.
void RemoveStaleFiles(const std::filesystem::path& folder,
                      const std::vector<std::filesystem::path>& kept);

}  // namespace lio
