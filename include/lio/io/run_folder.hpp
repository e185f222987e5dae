// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Keeps what a folder already has, when a run is to be written into it.
#pragma once

#include <filesystem>

namespace lio {

// Throws UsageError when `folder` exists and holds anything, unless it may be overwritten.
void RefuseUsedFolder(const std::filesystem::path& folder, bool overwrites);

// Makes `folder`, or, when it holds anything, the first of folder-2, folder-3 and so on that does
// not exist or is empty, and returns it. Throws std::runtime_error when none can be made.
[[nodiscard]] std::filesystem::path MakeFreeFolder(const std::filesystem::path& folder);

}  // namespace lio
