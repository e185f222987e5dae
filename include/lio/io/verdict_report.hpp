// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes the verdict on a run for people and for programs.
#pragma once

#include <filesystem>
#include <string>

#include "lio/verdict/verdict.hpp"

namespace lio {

// Returns the content of verdict.json: trust, coverage, claimed, causes (kind, leaves, sigma,
// evidence, fix); docs/design.md lists the words.
[[nodiscard]] std::string VerdictJson(const Verdict& verdict);
// Throws std::runtime_error naming the file when it cannot be written in full.
void WriteVerdict(const std::filesystem::path& folder, const Verdict& verdict);
// Returns some lines for users at the end of a run, each ended by a newline.
[[nodiscard]] std::string VerdictSummary(const Verdict& verdict);

}  // namespace lio
