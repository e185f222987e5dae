// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Defines what the command lines of all programs share: exit codes, errors in one line, and
// --config, --set and --print-options of the programs that run the pipeline.
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
  kExitUsage = 2,           // a wrong command line
  kExitConfiguration = 3,   // a missing or faulty file, key or value of the configuration
  kExitNoTransport = 4,     // LCM cannot be reached
  kExitUnusableInput = 5,   // damaged, missing or unusable input
  kExitNoTrust = 6,         // done, but the result cannot be trusted: verdict.json says why
  kExitInternalFault = 70,  // a thread of liod or lio-view failed: EX_SOFTWARE of sysexits.h
  kExitWriteFailed = 74,    // a file or stdout could not be written in full: EX_IOERR
};

// Parses the command line. Nothing means that the program goes on; otherwise it ends now with this
// exit code: kExitDone after --help and --version, kExitUsage after a usage error, which is told in
// one line on stderr. Adds --version, which prints `version`.
[[nodiscard]] std::optional<int> ParseCommandLine(CLI::App& app, int argc, const char* const* argv,
                                                  const std::string& version);

// Checks for CLI::Option::check: the option takes a finite number in that range. CLI11's own checks
// let NaN pass and print the largest double in full.
using TextCheck = std::function<std::string(const std::string&)>;
[[nodiscard]] TextCheck NumberWithin(double least, double most);
[[nodiscard]] TextCheck NumberFromZero();
[[nodiscard]] TextCheck NumberAboveZero();
[[nodiscard]] TextCheck WholeNumberFromZero();  // fits 64 bits
// The option takes a name of at most so many characters.
[[nodiscard]] TextCheck NameUpTo(std::size_t max_characters);

// Adds --start S and --duration S. The values must outlive the app.
void AddSpanArguments(CLI::App& app, double& start_s, double& duration_s);

// Adds --passes N.
void AddPassesArgument(CLI::App& app, int& num_passes);

struct OptionsArguments {
  std::vector<std::filesystem::path> files;  // --config, in order
  std::vector<std::string> sets;             // --set, in order
  bool print = false;                        // --print-options
};

// Adds --config FILE, --set KEY=VALUE (each takes exactly one value each time and may be given
// again) and --print-options, which makes other required arguments optional. `arguments` must
// outlive the app.
void AddOptionsArguments(CLI::App& app, OptionsArguments& arguments);

// Calls ParseCommandLine and then loads the options. Nothing means that the program goes on with
// valid `options`; otherwise it ends now with this exit code, which is also kExitDone after
// --print-options, whose text goes to stdout, and kExitConfiguration after faults of the
// configuration, each of which is told on a line of stderr.
[[nodiscard]] std::optional<int> ParseCommandLine(CLI::App& app, int argc, const char* const* argv,
                                                  const std::string& version,
                                                  OptionsArguments& arguments, Options& options);

}  // namespace lio
