// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The command line of liod.
#pragma once

#include <string>

#include "app/live_runner.hpp"
#include "lio/io/command_line.hpp"

namespace lio {

struct DaemonArguments {
  OptionsArguments options;
  std::string lcm_url;
  std::string out;
  std::string channel_prefix = kDefaultChannelPrefix;
  bool writes_map = false;
  bool publishes_full_cloud = false;

  // `this` must outlive the app.
  void AddTo(CLI::App& app);
  [[nodiscard]] LiveOptions Live() const;
};

}  // namespace lio
