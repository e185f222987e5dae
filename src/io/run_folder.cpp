// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/run_folder.hpp"

#include <fmt/format.h>

#include "lio/io/input_error.hpp"

namespace lio {
namespace fs = std::filesystem;
namespace {

bool HoldsAnything(const fs::path& folder) {
  std::error_code error;
  return fs::is_directory(folder, error) && !(fs::is_empty(folder, error) && !error);
}

// The path with a last part that a number can be added to: "a/b/" and "." have none.
fs::path WithName(const fs::path& folder) {
  fs::path named = folder;
  if (named.filename() == "." || named.filename() == "..") named = fs::absolute(named);
  named = named.lexically_normal();
  return named.has_filename() ? named : named.parent_path();
}

}  // namespace

void RefuseUsedFolder(const fs::path& folder, bool overwrites) {
  if (overwrites || !HoldsAnything(folder)) return;
  throw UsageError(folder.string() +
                   ": exists and is not empty; name another folder or add --overwrite");
}

fs::path MakeFreeFolder(const fs::path& folder) {
  const fs::path first = WithName(folder);
  fs::path candidate = first;
  std::error_code error;
  for (int number = 2; HoldsAnything(candidate); ++number) {
    candidate = first;
    candidate += fmt::format("-{}", number);
  }
  fs::create_directories(candidate, error);
  if (error) {
    throw std::runtime_error("cannot create " + candidate.string() + ": " + error.message());
  }
  return candidate;
}

}  // namespace lio
