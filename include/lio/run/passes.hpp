// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Replays a log once, or twice: a second pass begins with what the first has found of the sensors
// (FoundByReplay), where the first one had to find it on the way.
#pragma once

#include <filesystem>
#include <string>

#include "lio/io/log_input.hpp"
#include "lio/pipeline/options.hpp"
#include "lio/run/replay.hpp"
#include "lio/verdict/verdict.hpp"

namespace lio {

struct PassesRequest {
  std::filesystem::path log;
  LogInputOptions input;
  Options options;
  ReplaySettings settings;
  std::filesystem::path out;  // must be there or possible to make
  int num_passes = 1;         // 1 or 2
  // Nobody has told where the lidar sits: the second pass then has the axes of the messages.
  bool is_mounting_assumed = false;
};

struct PassesResult {
  Verdict verdict;
  std::string refusal;    // Replay::refusal
  std::string complaint;  // LogComplaint
  std::string failure;    // a file that could not be written, and why; stderr has told it
  // The same of a second pass: the files are those of the first then.
  std::string failure_of_second;
};

// Why the files of the first pass are kept in place of the second's; empty where they are not.
[[nodiscard]] std::string WhyFirstIsKept(const PassesResult& first, const PassesResult& second);

// Leaves the files of the last pass in the folder, or those of the first where WhyFirstIsKept says
// so; stderr tells it. Throws as LogInput and RunWriter do, but not for the second pass.
[[nodiscard]] PassesResult RunPasses(const PassesRequest& request);

}  // namespace lio
