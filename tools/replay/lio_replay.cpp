// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// lio-replay: runs the estimator over a log, without a clock and without dropping anything.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "lio/io/command_line.hpp"
#include "lio/io/cpu_clock.hpp"
#include "lio/io/event_log.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/initial_map_file.hpp"
#include "lio/io/input_guard.hpp"
#include "lio/io/program.hpp"
#include "lio/io/run_folder.hpp"
#include "lio/io/verdict_report.hpp"
#include "lio/report/run_report.hpp"
#include "lio/run/passes.hpp"

namespace lio {
namespace {

struct ReplayArguments {
  OptionsArguments options;
  std::string log;
  std::string out;
  bool overwrites = false;
  std::string channel_prefix = kDefaultChannelPrefix;
  std::optional<int> num_threads;
  bool writes_map = false;
  bool writes_report = false;
  std::string map_format = "pcd";
  InitialMapArguments initial_map;
  double start_s = 0.0;
  double duration_s = std::numeric_limits<double>::infinity();
  int match_lag = 0;
  int num_passes = 1;
};

constexpr const char* kDescription =
    "Runs LiDAR-inertial odometry over an LCM log, as fast as the machine goes.\n\n"
    "Writes into DIR, with one row per scan: trajectory_level.tum (the path as it looks when the\n"
    "run is over: steady, and level by the last estimate), trajectory.tum (as it was published on\n"
    "LIO_ODOM_LOCAL: the pose of imu in map, which never turns), trajectory_world.tum (as on\n"
    "LIO_ODOM: always level), the covariance*.csv of each; then trajectory_imu_rate.tum,\n"
    "registration.csv, states.csv, notices.tsv, stats.json, verdict.json (may the result be\n"
    "trusted, and if not, why), options.yaml, beams.yaml (the errors of the lidar's beams, which\n"
    "the next run takes as --config after the rig), map.pcd with --map, report.html with "
    "--report,\n"
    "and trajectory_base.tum when the rig has T_base_imu. If the clock goes back, segment_2/ and\n"
    "so on have every row from there on, besides. A summary of the verdict goes to stdout.\n"
    "The same log and options give the same files byte for byte, except for computing times.";

constexpr const char* kExamples =
    "Examples:\n"
    "  lio-replay --config config/ulhk.yaml drive.lcm --out out/drive\n"
    "  lio-replay --config config/ulhk.yaml --set pipeline.use_imu=false drive.lcm --out "
    "out/lidar\n"
    "  lio-replay --config config/default.yaml --config my_rig.yaml drive.lcm --out out --map\n"
    "  lio-replay --config my_rig.yaml next.lcm --out next --initial-map out/map.pcd\n\n"
    "Exit codes: 0 done, 2 usage, 3 configuration (also one that the log's data contradict),\n"
    "5 damaged, missing or unusable log or map, 6 done, but the result cannot be trusted: "
    "verdict.json\n"
    "and the summary on stdout say why and what to put into the configuration, 74 a file or "
    "stdout\n"
    "could not be written in full.";

void AddArguments(CLI::App& app, ReplayArguments& arguments) {
  app.footer(kExamples);
  app.add_option("LOG", arguments.log, "LCM log with LIO_IMU and LIO_SCAN")
      ->type_name("IN.lcm")
      ->required();
  app.add_option("--out", arguments.out, "Folder for the results; it must hold no earlier run")
      ->type_name("DIR")
      ->required();
  app.add_flag("--overwrite", arguments.overwrites, "Replace the files of an earlier run in DIR");
  app.add_option("--threads", arguments.num_threads,
                 "Instead of pipeline.num_threads; 2 or more also read and decode the log ahead")
      ->type_name("N")
      ->check(CLI::Range(1, 64));
  app.add_flag("--map", arguments.writes_map,
               "Write map.pcd with one point per voxel of 0.2 m, in narrow places of 0.05 m");
  app.add_flag("--report", arguments.writes_report,
               "Write report.html, a page with plots; with --map the path lies on the map");
  app.add_option("--map-format", arguments.map_format,
                 "Format of the map: pcd, or ply to have map.ply in place of map.pcd")
      ->needs("--map")
      ->check(CLI::IsMember({"pcd", "ply"}))
      ->capture_default_str();
  AddInitialMapArguments(app, arguments.initial_map);
  AddPassesArgument(app, arguments.num_passes);
  AddSpanArguments(app, arguments.start_s, arguments.duration_s);
  app.add_option("--channel-prefix", arguments.channel_prefix, "First part of the channels' names")
      ->type_name("NAME")
      ->capture_default_str();
  app.add_option(
         "--match-lag", arguments.match_lag,
         "Take each match's result N messages late, as liod does under load; the files must\n"
         "be the same, so this is a check")
      ->type_name("N")
      ->check(CLI::Range(0, 1000));
  AddOptionsArguments(app, arguments.options);
}

// A page that cannot be made does not spoil the run, but one that cannot be written does.
void TellReport(const ReplayArguments& arguments) {
  try {
    WriteReport(arguments.out, {arguments.log, std::nullopt, {}});
  } catch (const WriteError&) {
    throw;
  } catch (const std::runtime_error& error) {
    fmt::print(stderr, "lio-replay: no report: {}\n", error.what());
  }
}

// Tells how the run went; the exit code.
ExitCode End(const PassesResult& result, const ReplayArguments& arguments) {
  if (!result.refusal.empty()) {
    WriteVerdict(arguments.out, result.verdict);
    fmt::print(stderr, "lio-replay: {}\n", result.refusal);
    return kExitConfiguration;
  }
  if (arguments.writes_report && result.failure.empty()) TellReport(arguments);
  fmt::print("{}", VerdictSummary(result.verdict));
  if (!result.failure.empty() || !result.failure_of_second.empty()) return kExitWriteFailed;
  if (result.complaint.empty()) {
    return result.verdict.trust == Trust::kNo ? kExitNoTrust : kExitDone;
  }
  fmt::print(stderr, "lio-replay: {}\n", result.complaint);
  return kExitUnusableInput;
}

void GuardInputs(const ReplayArguments& arguments) {
  Paths inputs = arguments.options.files;
  inputs.insert(inputs.end(), {arguments.log, arguments.initial_map.map});
  RefuseToOverwrite(inputs, FilesOfRun(arguments.out));
}

int Main(int argc, char** argv) {
  CLI::App app(kDescription, "lio-replay");
  ReplayArguments arguments;
  AddArguments(app, arguments);
  Options options;
  if (const auto code =
          ParseCommandLine(app, argc, argv, LIO_VERSION, arguments.options, options)) {
    return *code;
  }
  LogInputOptions input_options;
  input_options.channels = Channels(arguments.channel_prefix);
  input_options.start_s = arguments.start_s;
  input_options.duration_s = arguments.duration_s;
  input_options.clock = ThreadCpuNs;
  if (arguments.num_threads) options.pipeline.num_threads = *arguments.num_threads;
  input_options.reads_ahead = options.pipeline.num_threads > 1;
  if (const std::string why = WhyNoLog(arguments.log); !why.empty()) {
    fmt::print(stderr, "lio-replay: {}\n", why);
    return kExitUnusableInput;
  }
  GuardInputs(arguments);
  ReplaySettings settings;
  if (const auto code =
          LoadInitialMap("lio-replay", arguments.initial_map, options, settings.initial_map)) {
    return *code;
  }
  (void)EventLogReader(arguments.log);  // a log that is missing is told before all else
  RefuseEarlierRun(arguments.out, arguments.overwrites);
  MakeFolder(arguments.out);
  settings.program = "lio-replay";
  settings.writes_map = arguments.writes_map;
  settings.map_format = arguments.map_format == "ply" ? MapFormat::kPly : MapFormat::kPcd;
  settings.match_lag = arguments.match_lag;
  return End(RunPasses({arguments.log, input_options, options, settings, arguments.out,
                        arguments.num_passes}),
             arguments);
}

}  // namespace
}  // namespace lio

int main(int argc, char** argv) {
  return lio::RunProgram("lio-replay", [&] { return lio::Main(argc, argv); });
}
