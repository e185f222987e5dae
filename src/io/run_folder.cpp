// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/run_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <vector>

#include "lio/io/input_error.hpp"
#include "lio/io/input_guard.hpp"

namespace lio {
namespace fs = std::filesystem;
namespace {

// Looks for the first file that a run writes, for the one that a killed run leaves in any case, and
// for a map, which is somebody's input and would be removed.
bool HoldsRun(const fs::path& folder) {
  constexpr std::array<const char*, 4> kSigns = {"options.yaml", "trajectory.tum", "map.pcd",
                                                 "map.ply"};
  return std::any_of(kSigns.begin(), kSigns.end(), [&](const char* name) {
    std::error_code ignored;
    return fs::exists(folder / name, ignored);
  });
}

// The path with a last part that a number can be added to: "a/b/" and "." have none.
fs::path WithName(const fs::path& folder) {
  fs::path named = folder;
  if (named.filename() == "." || named.filename() == "..") named = fs::absolute(named);
  named = named.lexically_normal();
  return named.has_filename() ? named : named.parent_path();
}

}  // namespace

void RefuseEarlierRun(const fs::path& folder, bool overwrites) {
  if (overwrites || !HoldsRun(folder)) return;
  throw UsageError(folder.string() +
                   ": holds an earlier run; name another folder or add --overwrite");
}

fs::path FreeFolder(const fs::path& folder) {
  const fs::path first = WithName(folder);
  fs::path candidate = first;
  for (int number = 2; HoldsRun(candidate); ++number) {
    candidate = first;
    candidate += fmt::format("-{}", number);
  }
  return candidate;
}

fs::path MakeFreeFolder(const fs::path& folder) {
  const fs::path candidate = FreeFolder(folder);
  MakeFolder(candidate);
  return candidate;
}

void MakeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw UsageError("--out: cannot create " + folder.string() + ": " + error.message());
}

void ReplaceRun(const fs::path& folder, const fs::path& by) {
  Paths old = FilesOfRun(folder);
  old.push_back(folder / "beams.yaml");
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(by)) {
    const fs::path target = folder / fs::relative(entry.path(), by);
    if (entry.is_directory()) {
      fs::create_directories(target);
    } else {
      files.push_back(entry.path());
      std::erase(old, target);
    }
  }
  for (const fs::path& file : files) fs::rename(file, folder / fs::relative(file, by));
  for (const fs::path& file : old) {
    if (!fs::is_directory(file)) fs::remove(file);
  }
  for (int segment = 2;; ++segment) {
    const std::string name = fmt::format("segment_{}", segment);
    if (!fs::is_directory(folder / name)) break;
    if (!fs::is_directory(by / name)) fs::remove_all(folder / name);
  }
}

std::string WhyNotWritable(const fs::path& folder) {
  std::error_code ignored;
  fs::path existing = fs::absolute(WithName(folder));
  while (!fs::exists(existing, ignored) && existing.has_relative_path()) {
    existing = existing.parent_path();
  }
  if (!fs::is_directory(existing, ignored)) return existing.string() + " is not a folder";
  if (::access(existing.c_str(), W_OK | X_OK) == 0) return {};
  return existing.string() + " may not be written by this user";
}

}  // namespace lio
