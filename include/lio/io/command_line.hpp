// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// What the command lines of all programs share: exit codes, errors in one line, and --config, --set
// and --print-options of the programs that run the pipeline.
#pragma once

#include <filesystem>
#include <functional>
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

// For CLI::Option::check: the option takes a finite number in that range. CLI11's own checks let
// NaN pass, and tell the largest double in full.
using TextCheck = std::function<std::string(const std::string&)>;
TextCheck NumberWithin(double least, double most);
TextCheck NumberFromZero();
TextCheck NumberAboveZero();
TextCheck WholeNumberFromZero();  // of 64 bits
// And: a name of at most so many characters.
TextCheck NameUpTo(std::size_t max_characters);

// Throws UsageError when writing `output` would destroy `input`, which is the same file; or, when
// `input` is a folder, a file of recorded data in it.
void RefuseToOverwrite(const std::filesystem::path& input, const std::filesystem::path& output);

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
