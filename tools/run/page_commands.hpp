// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The commands of lio-run that take folders of finished runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lio/io/command_line.hpp"

namespace lio {

struct PageArguments {
  std::vector<std::string> inputs;
  std::string out;
  std::optional<std::filesystem::path> truth;
  bool overwrites = false;
};

// Writes the page of one run anew, or one page of several runs, when `inputs` are such folders;
// else nothing. Throws UsageError for several inputs of which one is no run.
[[nodiscard]] std::optional<ExitCode> WritePages(const PageArguments& arguments);

}  // namespace lio
