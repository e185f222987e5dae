// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Keeps what a program reads from what it writes. Each program asks before it opens the first file,
// and names all that it will read, also what it finds by default.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lio {

using Paths = std::vector<std::filesystem::path>;

// Says that writing one of `outputs` would destroy one of `inputs`, which it does when both are the
// same file, by whatever names, or when an input is a folder and the output a file of recorded data
// in it; empty when nothing is destroyed. Empty paths are passed over.
[[nodiscard]] std::string WhyInputIsLost(const Paths& inputs, const Paths& outputs);
// Throws UsageError that says so.
void RefuseToOverwrite(const Paths& inputs, const Paths& outputs);

// Returns the paths of all files that a run in `folder` writes or removes, and those in its
// segments.
[[nodiscard]] Paths FilesOfRun(const std::filesystem::path& folder);

}  // namespace lio
