// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the command line of liod.
#pragma once

#include <string>

#include "app/live_runner.hpp"
#include "lio/io/command_line.hpp"
#include "lio/io/initial_map_file.hpp"
#include "lio/io/input_guard.hpp"

namespace lio {

struct DaemonArguments {
  OptionsArguments options;
  std::string lcm_url;
  std::string out;
  bool overwrites = false;
  std::string channel_prefix = kDefaultChannelPrefix;
  bool writes_map = false;
  InitialMapArguments initial_map;
  bool publishes_full_cloud = false;
  bool checks_only = false;

  // `this` must outlive the app.
  void AddTo(CLI::App& app);
  // They lack the initial map, which must be loaded.
  [[nodiscard]] LiveOptions Live() const;
  // Returns the files that a start reads.
  [[nodiscard]] Paths Inputs() const;
  // Returns the folder that the files of a start would go to; empty without --out.
  [[nodiscard]] std::filesystem::path FolderOfFiles() const;
  // Says that the files of --out would replace one of the inputs; empty when they do not.
  [[nodiscard]] std::string WhyInputIsLost() const;
};

}  // namespace lio
