// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "lio/io/options_yaml.hpp"

namespace lio {
namespace {

// Thrown by the flag's callback, which CLI11 runs before it asks for required arguments.
struct PrintOptionsRequest : CLI::Success {
  PrintOptionsRequest() : CLI::Success("print options", CLI::ExitCodes::Success) {}
};

std::string OneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string CheckKeyValue(const std::string& set) {
  const std::size_t equals = set.find('=');
  const bool is_usable = equals != std::string::npos && equals > 0;
  return is_usable ? "" : "expects KEY=VALUE, not '" + set + "'";
}

}  // namespace

std::optional<int> ParseCommandLine(CLI::App& app, int argc, const char* const* argv,
                                    const std::string& version) {
  app.set_version_flag("--version", app.get_name() + " " + version, "Print the version and exit");
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const PrintOptionsRequest&) {
    return std::nullopt;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    std::cerr << app.get_name() << ": " << OneLine(e.what()) << " (see --help)\n";
    return kExitUsage;
  }
}

void AddOptionsArguments(CLI::App& app, OptionsArguments& arguments) {
  const std::string group = "Configuration";
  const auto take_files = [&arguments](const std::vector<std::string>& files) {
    arguments.files.assign(files.begin(), files.end());
  };
  app.add_option_function<std::vector<std::string>>(
         "--config", take_files, "YAML file; later files override earlier ones key by key")
      ->type_name("FILE")
      ->type_size(1)
      ->allow_extra_args(false)
      ->group(group);
  app.add_option("--set", arguments.sets, "Override one key, e.g. ndt.voxel_m=1.5; VALUE is YAML")
      ->type_name("KEY=VALUE")
      ->type_size(1)
      ->allow_extra_args(false)
      ->check(CheckKeyValue)
      ->group(group);
  // After the two above: CLI11 runs callbacks in this order.
  const auto request = [&arguments] {
    arguments.print = true;
    throw PrintOptionsRequest();
  };
  app.add_flag_callback("--print-options", request, "Print the effective options and exit")
      ->group(group);
}

std::optional<int> ParseCommandLine(CLI::App& app, int argc, const char* const* argv,
                                    const std::string& version, OptionsArguments& arguments,
                                    Options& options) {
  if (const std::optional<int> exit_code = ParseCommandLine(app, argc, argv, version)) {
    return exit_code;
  }
  LoadResult loaded = LoadOptions(arguments.files, arguments.sets);
  if (arguments.print) std::cout << PrintOptions(loaded.options);
  for (const std::string& fault : loaded.faults) {
    std::cerr << app.get_name() << ": " << fault << "\n";
  }
  if (!loaded.faults.empty()) return kExitConfiguration;
  if (arguments.print) return kExitDone;
  options = std::move(loaded.options);
  return std::nullopt;
}

}  // namespace lio
