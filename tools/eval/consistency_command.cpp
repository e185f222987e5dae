// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <iostream>

#include "eval_program.hpp"
#include "lio/eval/consistency_report.hpp"
#include "lio/io/command_line.hpp"
#include "lio/io/input_guard.hpp"
#include "plot_runner.hpp"

namespace lio {
namespace {

constexpr char kFooter[] = R"(
Each ESTIMATE_DIR was written by lio-replay or liod with --out. It has trajectory.tum and
covariance.csv, or with --world trajectory_world.tum and covariance_world.csv, or with --level
trajectory_level.tum and covariance_level.csv, and, for the innovations, registration.csv.
docs/evaluation.md explains each figure.

Examples:
  lio-eval consistency truth.tum runs/seed_*           one truth for all runs
  lio-eval consistency truth.tum runs/seed_* --json out/nees.json --plot out/nees.png
                                                       a truth.tum in each run's folder)";

struct Arguments {
  std::string truth;
  std::vector<std::string> dirs;
  std::string json;
  std::string plot;
  bool in_world = false;
  bool is_level = false;
};

RunFrame FrameOf(const Arguments& arguments) {
  if (arguments.in_world) return RunFrame::kWorld;
  return arguments.is_level ? RunFrame::kLevel : RunFrame::kMap;
}

int Run(const Arguments& arguments) {
  const RunFrame frame = FrameOf(arguments);
  for (const std::string& dir : arguments.dirs) {
    const std::filesystem::path truth_in_run = std::filesystem::path(dir) / arguments.truth;
    RefuseToOverwrite({arguments.truth, truth_in_run}, {arguments.json, arguments.plot});
    RefuseToOverwrite(FilesOfRun(dir), {arguments.json, arguments.plot});
  }
  std::vector<RunErrors> runs;
  for (const std::string& dir : arguments.dirs) {
    runs.push_back(ComputeRunErrors(LoadRun(dir, arguments.truth, frame)));
  }
  const Consistency consistency = JudgeConsistency(runs);
  std::cout << ConsistencyText(consistency) << std::flush;
  if (!arguments.json.empty()) WriteJson(arguments.json, ConsistencyJson(consistency));
  if (arguments.plot.empty()) return kExitDone;
  return RunPlot(kProgram, "plot_consistency.py", ConsistencyPictureData(consistency),
                 {arguments.plot});
}

}  // namespace

int ConsistencyMain(int argc, const char* const* argv) {
  CLI::App app("Judges covariances: NEES and NIS of runs against their chi-square bands.",
               "lio-eval consistency");
  Arguments arguments;
  app.add_option(
         "TRUTH", arguments.truth,
         "True trajectory (TUM): the file of this name in each ESTIMATE_DIR, else this file")
      ->required()
      ->type_name("FILE");
  app.add_option("ESTIMATE_DIR", arguments.dirs, "Folders of runs")->required()->type_name("");
  CLI::Option* const world =
      app.add_flag("--world", arguments.in_world,
                   "Judge the poses in world, which is always level, instead of those in map");
  app.add_flag("--level", arguments.is_level,
               "Judge the path that is level by the last estimate, the one to keep")
      ->excludes(world);
  app.add_option("--json", arguments.json, "Write the figures into this file")->type_name("FILE");
  app.add_option("--plot", arguments.plot, "Draw NEES and NIS over time with their bands")
      ->type_name("FILE.png");
  app.footer(kFooter);
  if (const auto exit_code = ParseCommandLine(app, argc, argv, LIO_VERSION)) return *exit_code;
  return Run(arguments);
}

}  // namespace lio
