// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/program.hpp"

#include <csignal>
#include <cstdio>
#include <iostream>

#include "lio/io/command_line.hpp"
#include "lio/io/input_error.hpp"

namespace lio {
namespace {

bool IsStdoutWhole() {
  std::cout.flush();
  return std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
}

int Tell(const std::string& name, const std::exception& error, int exit_code) {
  std::cerr << name << ": " << error.what() << "\n";
  return exit_code;
}

int RunTelling(const std::string& name, const std::function<int()>& body) {
  try {
    return body();
  } catch (const UsageError& error) {
    return Tell(name, error, kExitUsage);
  } catch (const WriteError& error) {
    return Tell(name, error, kExitWriteFailed);
  } catch (const OutputError& error) {
    return Tell(name, error, kExitUsage);
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) return kExitDone;  // fmt::print throws; the caller tells
    return Tell(name, error, kExitUnusableInput);
  }
}

}  // namespace

int RunProgram(const std::string& name, const std::function<int()>& body) {
  std::signal(SIGXFSZ, SIG_IGN);
  const int exit_code = RunTelling(name, body);
  if (IsStdoutWhole()) return exit_code;
  std::cerr << name << ": cannot write to the standard output in full\n";
  return exit_code == kExitDone || exit_code == kExitNoTrust ? kExitWriteFailed : exit_code;
}

}  // namespace lio
