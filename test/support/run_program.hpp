// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs a program as a user would, and keeps what it said.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "support/temp_dir.hpp"

namespace lio::test {

struct ProgramResult {
  int exit_code = -1;  // -1: killed or not started
  std::string out;
  std::string err;
};

// `environment` holds NAME=VALUE entries, added to this process' own.
inline ProgramResult RunProgram(const std::vector<std::string>& command,
                                const std::vector<std::string>& environment = {}) {
  const TempDir dir;
  std::string line = "env";
  const auto add = [&line](const std::string& before, const std::string& word) {
    line.append(before).append("'");
    for (char c : word) line.append(c == '\'' ? "'\\''" : std::string(1, c));
    line.append("'");
  };
  for (const std::string& entry : environment) add(" ", entry);
  for (const std::string& word : command) add(" ", word);
  add(" >", (dir.path() / "out").string());
  add(" 2>", (dir.path() / "err").string());
  line.append(" </dev/null");
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, ReadText(dir.path() / "out"),
          ReadText(dir.path() / "err")};
}

}  // namespace lio::test
