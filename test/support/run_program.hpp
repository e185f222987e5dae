// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs a program as a user would, and keeps its output.
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
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

// Returns the largest memory that the program held at once [kB], or -1 when it did not end with 0.
inline std::int64_t PeakMemoryKb(std::vector<std::string> command) {
  std::vector<char*> words;
  for (std::string& word : command) words.push_back(word.data());
  words.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    const bool is_quiet = std::freopen("/dev/null", "w", stdout) != nullptr;
    if (is_quiet) execv(words[0], words.data());
    _exit(127);
  }
  int status = -1;
  rusage usage{};
  if (child < 0 || wait4(child, &status, 0, &usage) != child || status != 0) return -1;
  return usage.ru_maxrss;
}

}  // namespace lio::test
