// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Keeps an earlier run when another one is to be written into its folder. Other files do not count:
// a script may have put the configuration there, or what the program prints.
#pragma once

#include <filesystem>

namespace lio {

// Throws UsageError when `folder` holds an earlier run, unless it may be overwritten.
void RefuseEarlierRun(const std::filesystem::path& folder, bool overwrites);

// Makes `folder`, or, when it holds an earlier run, the first of folder-2, folder-3 and so on that
// does not, and returns it. Throws std::runtime_error when none can be made.
[[nodiscard]] std::filesystem::path MakeFreeFolder(const std::filesystem::path& folder);

}  // namespace lio
