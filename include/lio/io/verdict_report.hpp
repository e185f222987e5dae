// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The verdict on a run for people and for programs.
#pragma once

#include <filesystem>
#include <string>

#include "lio/verdict/verdict.hpp"

namespace lio {

// The content of verdict.json: trust, coverage, claimed, causes (kind, leaves, sigma, evidence,
// fix); docs/design.md lists the words.
[[nodiscard]] std::string VerdictJson(const Verdict& verdict);
// Throws std::runtime_error naming the file when it cannot be written in full.
void WriteVerdict(const std::filesystem::path& folder, const Verdict& verdict);
// Some lines for users at the end of a run, each ended by a newline.
[[nodiscard]] std::string VerdictSummary(const Verdict& verdict);

}  // namespace lio
