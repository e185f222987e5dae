// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the command line of lio-run.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lio/io/command_line.hpp"

namespace CLI {
class App;
}

namespace lio {

// This is the first part of --help.
extern const char* const kAbout;

struct RunArguments {
  std::vector<std::string> inputs;
  [[nodiscard]] const std::string& input() const { return inputs.front(); }  // the first of them
  std::string out;
  std::string rig;
  std::string truth;
  std::string lidar_topic, imu_topic, truth_topic, imu_file;
  OptionsArguments options;
  std::optional<int> num_threads;
  int num_passes = 2;
  double start_s = 0.0;
  double duration_s = std::numeric_limits<double>::infinity();
  bool overwrites = false;
};

void AddArguments(CLI::App& app, RunArguments& arguments);

}  // namespace lio
