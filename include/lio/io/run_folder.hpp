// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Keeps an earlier run when another one is to be written into its folder. Other files do not count:
// a script may have put the configuration there, or what the program prints.
#pragma once

#include <filesystem>
#include <string>

namespace lio {

// Throws UsageError when `folder` holds an earlier run, unless it may be overwritten.
void RefuseEarlierRun(const std::filesystem::path& folder, bool overwrites);

// Returns `folder` or, when it holds an earlier run, the first of folder-2, folder-3 and so on that
// does not. Makes nothing.
[[nodiscard]] std::filesystem::path FreeFolder(const std::filesystem::path& folder);

// Throws UsageError when it cannot be made.
void MakeFolder(const std::filesystem::path& folder);

// Makes FreeFolder(folder) and returns it. Throws as MakeFolder does.
[[nodiscard]] std::filesystem::path MakeFreeFolder(const std::filesystem::path& folder);

// Puts the files of a whole run in the folder `by` into the place of those of another: each new
// file over its old one, then away with the old ones that have no new one. `by` is in the same file
// system. Throws std::filesystem::filesystem_error where that fails; no file is lost then.
void ReplaceRun(const std::filesystem::path& folder, const std::filesystem::path& by);

// Why no files can be written into `folder`, in one line; empty when they can, or when the folder
// is missing and can be made. Makes nothing.
[[nodiscard]] std::string WhyNotWritable(const std::filesystem::path& folder);

}  // namespace lio
