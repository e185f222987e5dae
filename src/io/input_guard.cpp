// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/input_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "lio/io/input_error.hpp"

namespace lio {
namespace fs = std::filesystem;
namespace {

constexpr std::array<const char*, 18> kFilesOfRun = {"trajectory.tum",
                                                     "covariance.csv",
                                                     "trajectory_world.tum",
                                                     "covariance_world.csv",
                                                     "trajectory_level.tum",
                                                     "covariance_level.csv",
                                                     "trajectory_level.rows",
                                                     "trajectory_base.tum",
                                                     "trajectory_imu_rate.tum",
                                                     "states.csv",
                                                     "registration.csv",
                                                     "notices.tsv",
                                                     "options.yaml",
                                                     "stats.json",
                                                     "verdict.json",
                                                     "map.pcd",
                                                     "map.ply",
                                                     "report.html"};

constexpr std::array<const char*, 5> kRecordedKinds = {".bag", ".db3", ".mcap", ".bin", ".txt"};

bool IsRecordedKind(const fs::path& file) {
  const std::string extension = file.extension().string();
  return file.filename() == "metadata.yaml" ||
         std::find(kRecordedKinds.begin(), kRecordedKinds.end(), extension) != kRecordedKinds.end();
}

// Is the file one of recorded data somewhere in the folder?
bool IsDataIn(const fs::path& folder, const fs::path& file) {
  std::error_code ignored;
  const bool can_be = fs::is_directory(folder, ignored) && fs::is_regular_file(file, ignored);
  if (!can_be || !IsRecordedKind(file)) return false;
  fs::path around = fs::weakly_canonical(file, ignored).parent_path();
  for (; around.has_relative_path(); around = around.parent_path()) {
    if (fs::equivalent(around, folder, ignored)) return true;
  }
  return false;
}

}  // namespace

std::string WhyInputIsLost(const Paths& inputs, const Paths& outputs) {
  std::error_code ignored;
  for (const fs::path& output : outputs) {
    for (const fs::path& input : inputs) {
      if (input.empty() || output.empty()) continue;
      if (!fs::equivalent(input, output, ignored) && !IsDataIn(input, output)) continue;
      return output.string() + ": is input, name another file to write";
    }
  }
  return {};
}

void RefuseToOverwrite(const Paths& inputs, const Paths& outputs) {
  if (const std::string why = WhyInputIsLost(inputs, outputs); !why.empty()) throw UsageError(why);
}

Paths FilesOfRun(const fs::path& folder) {
  Paths files;
  for (const char* name : kFilesOfRun) files.push_back(folder / name);
  std::error_code ignored;
  for (int segment = 2;; ++segment) {
    const fs::path in_segment = folder / fmt::format("segment_{}", segment);
    if (!fs::is_directory(in_segment, ignored)) return files;
    for (const auto& entry : fs::recursive_directory_iterator(in_segment, ignored)) {
      files.push_back(entry.path());
    }
  }
}

}  // namespace lio
