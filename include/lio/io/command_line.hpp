// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// What the command lines of all programs share: exit codes, errors in one line, and --config, --set
// and --print-options of the programs that run the pipeline.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lio/pipeline/options.hpp"

namespace CLI {
class App;
}

namespace lio {

enum ExitCode : int {
  kExitDone = 0,
  kExitUsage = 2,          // a wrong command line
  kExitConfiguration = 3,  // a missing or faulty file, key or value of the configuration
  kExitNoTransport = 4,    // LCM cannot be reached
  kExitUnusableInput = 5,  // damaged, missing or unusable input
};

// Parses; empty means go on. Otherwise the exit code to end with now: kExitDone after --help and
// --version, kExitUsage after a usage error, told in one line on stderr. Adds --version (of
// LIO_VERSION, passed by the caller).
std::optional<int> ParseCommandLine(CLI::App& app, int argc, const char* const* argv,
                                    const std::string& version);

struct OptionsArguments {
  std::vector<std::filesystem::path> files;  // --config, in order
  std::vector<std::string> sets;             // --set, in order
  bool print = false;                        // --print-options
};

// Adds --config FILE, --set KEY=VALUE (each takes exactly one value each time and may be given
// again) and --print-options, which makes other required arguments optional. `arguments` must
// outlive the app.
void AddOptionsArguments(CLI::App& app, OptionsArguments& arguments);

// ParseCommandLine, then loads the options. Empty means go on with valid `options`. Otherwise the
// exit code: also kExitDone after --print-options, whose text goes to stdout, and
// kExitConfiguration, with every fault on a line of stderr.
std::optional<int> ParseCommandLine(CLI::App& app, int argc, const char* const* argv,
                                    const std::string& version, OptionsArguments& arguments,
                                    Options& options);

}  // namespace lio
