// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds the real recordings that tests may use: in the folder that the environment's LIO_DATA
// names, else in ../shared/data beside the source tree. A test without them is skipped:
//
//   LIO_REQUIRE_SHARED_DATA(drive, "kitti_raw_0005_first80.tar.xz");  // drive: where it is
//   unpacked
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "support/build_paths.hpp"

namespace lio::test {

inline std::filesystem::path SharedDataFolder() {
  if (const char* given = std::getenv("LIO_DATA")) return given;
  return std::filesystem::path(SourceDir()).parent_path() / "shared" / "data";
}

// Unpacks "x.bag.xz" to the file x.bag, and "x.tar.xz" to a folder with the archive's content, once
// per build folder. Returns an empty path when the archive is missing or cannot be unpacked.
inline std::filesystem::path UnpackSharedData(const std::string& archive) {
  namespace fs = std::filesystem;
  const fs::path source = SharedDataFolder() / archive;
  if (!fs::exists(source)) return {};
  const bool is_tar = archive.ends_with(".tar.xz");
  const fs::path target =
      fs::path(TestDataDir()) / archive.substr(0, archive.size() - (is_tar ? 7 : 3));
  if (fs::exists(target)) return target;
  // Tests run in parallel: each unpacks for itself, and the first to finish names the result.
  const fs::path own = target.string() + "." + std::to_string(getpid());
  fs::create_directories(target.parent_path());
  if (is_tar) fs::create_directories(own);
  const std::string command = is_tar
                                  ? "tar -xJf '" + source.string() + "' -C '" + own.string() + "'"
                                  : "xz -dc '" + source.string() + "' > '" + own.string() + "'";
  if (std::system(command.c_str()) != 0) return {};
  std::error_code lost_the_race;
  fs::rename(own, target, lost_the_race);
  if (lost_the_race) fs::remove_all(own);
  return target;
}

}  // namespace lio::test

#define LIO_REQUIRE_SHARED_DATA(name, archive)                                         \
  const std::filesystem::path name = lio::test::UnpackSharedData(archive);             \
  if (name.empty())                                                                    \
  GTEST_SKIP() << (archive) << " is not in " << lio::test::SharedDataFolder().string() \
               << " (set LIO_DATA to the folder that has it)"
