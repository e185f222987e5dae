// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <iostream>
#include <sstream>

#include "lio/io/options_yaml.hpp"

namespace lio {
namespace {

// It is thrown by the flag's callback, which CLI11 runs before it asks for required arguments.
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

template <typename Number>
std::optional<Number> Parse(const std::string& text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + text.starts_with('+'), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

template <typename Accept>
TextCheck NumberThat(const std::string& is_what, Accept accept) {
  return [is_what, accept](const std::string& text) -> std::string {
    const auto value = Parse<double>(text);
    if (value && std::isfinite(*value) && accept(*value)) return "";
    return "expects a number " + is_what + ", not '" + text + "'";
  };
}

std::string ShortText(double number) {
  std::ostringstream stream;
  stream << number;
  return stream.str();
}

}  // namespace

TextCheck NumberWithin(double least, double most) {
  return NumberThat("within " + ShortText(least) + " .. " + ShortText(most),
                    [=](double value) { return value >= least && value <= most; });
}

TextCheck NumberFromZero() {
  return NumberThat("from 0 on", [](double value) { return value >= 0.0; });
}

TextCheck NumberAboveZero() {
  return NumberThat("above 0", [](double value) { return value > 0.0; });
}

TextCheck WholeNumberFromZero() {
  return [](const std::string& text) -> std::string {
    if (Parse<std::uint64_t>(text)) return "";
    return "expects a whole number from 0 on, not '" + text + "'";
  };
}

TextCheck NameUpTo(std::size_t max_characters) {
  return [max_characters](const std::string& text) -> std::string {
    if (text.size() <= max_characters) return "";
    return "expects a name of at most " + std::to_string(max_characters) + " characters, not of " +
           std::to_string(text.size());
  };
}

void AddSpanArguments(CLI::App& app, double& start_s, double& duration_s) {
  app.add_option("--start", start_s, "Leave out the first S seconds")
      ->type_name("S")
      ->check(NumberFromZero());
  app.add_option("--duration", duration_s, "Use only S seconds")
      ->type_name("S")
      ->check(NumberAboveZero());
}

void AddPassesArgument(CLI::App& app, int& num_passes) {
  app.add_option("--passes", num_passes,
                 "Replay once, as liod would, or twice: the second pass begins with what the first "
                 "has\n"
                 "found of the sensors (the errors of the beams, clocks, mounting, units), so that "
                 "the\n"
                 "path is right from its start on. Files are those of the last pass")
      ->type_name("N")
      ->check(CLI::Range(1, 2))
      ->capture_default_str();
}

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
  // This flag is added after the two options above, because CLI11 runs callbacks in this order.
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
