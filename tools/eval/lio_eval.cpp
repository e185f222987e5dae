// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// lio-eval: measures how far a trajectory is from the truth; and lio-eval consistency.
#include <CLI/CLI.hpp>
#include <iostream>
#include <string_view>

#include "compare_command.hpp"
#include "eval_program.hpp"
#include "lio/eval/evaluation.hpp"
#include "lio/eval/report.hpp"
#include "lio/io/command_line.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/input_guard.hpp"
#include "lio/io/output_file.hpp"
#include "lio/io/program.hpp"
#include "plot_runner.hpp"

namespace lio {
namespace {

constexpr char kFooter[] = R"(
Files are TUM (t x y z qx qy qz qw) or KITTI (12 numbers per row); the format is detected.
docs/evaluation.md explains each figure.

Examples:
  lio-eval truth.tum out/run                      a run's folder: its trajectory_level.tum
  lio-eval truth.tum out/run/trajectory.tum       the path as it was published
  lio-eval truth.tum out/run --json out/eval.json --plot out/eval.png --map out/run/map.pcd
  lio-eval truth.tum out/a out/b --csv table.csv  several runs in one table
  lio-eval truth.tum out/run --time-offset auto   where the clocks differ
  lio-eval poses/05.txt mine.txt --align none
  lio-eval consistency --help                     to judge the covariance

Exit codes: 0 done, 2 usage, 3 no matplotlib for the pictures, 5 missing or unusable input, 74 a
file or stdout could not be written in full.)";

struct Arguments {
  std::string truth;
  std::vector<std::string> estimates;
  std::string time_offset = "0";
  std::string align = "se3";
  std::optional<double> max_gap_s;
  std::string json;
  std::string csv;
  std::string plot;
  std::string plots;
  std::string map;
};

void Describe(CLI::App& app, Arguments& arguments) {
  app.add_option("TRUTH", arguments.truth, "True trajectory")->required()->type_name("FILE");
  app.add_option("ESTIMATE", arguments.estimates,
                 "Estimated trajectory, or a run's folder; several make one table")
      ->required()
      ->type_name("FILE|DIR");
  app.add_option("--align", arguments.align,
                 "Move the estimate onto the truth: not at all, about z, or freely (default se3)")
      ->check(CLI::IsMember({"none", "yaw", "se3"}).description(""))
      ->type_name("none|yaw|se3");
  app.add_option("--max-gap", arguments.max_gap_s,
                 "Interpolate across gaps of at most so many seconds (default: from the data)")
      ->check(NumberAboveZero())
      ->type_name("S");
  app.add_option("--time-offset", arguments.time_offset,
                 "Seconds to add to the estimate's stamps; auto finds those of the least error")
      ->check(TextCheck([](const std::string& text) {
        return text == "auto" ? std::string() : NumberWithin(-1e6, 1e6)(text);
      }))
      ->type_name("auto|S");
  app.add_option("--csv", arguments.csv, "Write the table of the runs into this file")
      ->type_name("FILE");
  app.add_option("--json", arguments.json, "Write the figures into this file")->type_name("FILE");
  app.add_option("--plot", arguments.plot, "Draw paths, errors and height in one picture")
      ->type_name("FILE.png");
  app.add_option("--plots", arguments.plots, "Draw path.png, error.png and, with --map, map.png")
      ->type_name("DIR");
  app.add_option("--map", arguments.map, "Point cloud (in the estimate's world) behind the paths")
      ->type_name("FILE.pcd");
  app.footer(kFooter);
}

EvaluationOptions ToOptions(const Arguments& arguments) {
  const AlignMode mode = arguments.align == "none"  ? AlignMode::kNone
                         : arguments.align == "yaw" ? AlignMode::kYaw
                                                    : AlignMode::kSe3;
  return {mode, arguments.max_gap_s};
}

int Draw(const Arguments& arguments, const Evaluation& evaluation, const ReportedFiles& files) {
  if (arguments.plot.empty() && arguments.plots.empty()) return kExitDone;
  std::vector<std::string> words;
  if (!arguments.plot.empty()) words.insert(words.end(), {"--overview", arguments.plot});
  if (!arguments.plots.empty()) words.insert(words.end(), {"--folder", arguments.plots});
  if (!arguments.map.empty()) words.insert(words.end(), {"--map", arguments.map});
  return RunPlot(kProgram, "plot_trajectory.py", PictureData(evaluation, files), words);
}

TimeOffsetWish ToWish(const Arguments& arguments) {
  if (arguments.time_offset == "auto") return {true, 0.0};
  return {false, std::stod(arguments.time_offset)};
}

void GuardInputs(const Arguments& arguments) {
  Paths outputs = {arguments.json, arguments.csv, arguments.plot};
  for (const char* picture : {"path.png", "error.png", "map.png"}) {
    if (!arguments.plots.empty())
      outputs.push_back(std::filesystem::path(arguments.plots) / picture);
  }
  RefuseToOverwrite({arguments.truth, arguments.map}, outputs);
  for (const std::string& estimate : arguments.estimates) {
    RefuseToOverwrite({estimate}, outputs);
    RefuseToOverwrite(FilesOfRun(estimate), outputs);
  }
}

// Refuses what cannot be read or must not be overwritten; empty when nothing is wrong.
std::string WhyNotScored(const Arguments& arguments) {
  const bool draws = !arguments.plot.empty() || !arguments.plots.empty();
  if (draws && arguments.estimates.size() > 1) {
    throw UsageError("--plot and --plots draw one run; name a single ESTIMATE");
  }
  std::vector<std::string> files = arguments.estimates;
  files.push_back(arguments.truth);
  GuardInputs(arguments);
  for (const std::string& file : files) {
    const bool is_run = KindOf(file) == FileKind::kRunFolder && file != arguments.truth;
    if (const std::string why = WhyNoTrajectory(file); !is_run && !why.empty()) return why;
  }
  return {};
}

void WriteFigures(const Arguments& arguments, const std::vector<ScoredRun>& runs) {
  if (!arguments.csv.empty()) {
    WriteText(arguments.csv, ComparisonCsv(runs), OutputFile::Links::kFollowed);
  }
  if (arguments.json.empty()) return;
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const ScoredRun& run : runs) {
    all.push_back(EvaluationJson(run.evaluation, {arguments.truth, run.file}));
    all.back()["time_offset_s"] = run.time_offset_s;
  }
  WriteJson(arguments.json, runs.size() == 1 ? all.front() : all);
}

void Print(const Arguments& arguments, const std::vector<ScoredRun>& runs) {
  if (runs.size() > 1) {
    std::cout << ComparisonText(runs) << std::flush;
    return;
  }
  std::cout << EvaluationText(runs[0].evaluation, {arguments.truth, runs[0].file});
  if (runs[0].time_offset_s != 0.0) {
    std::cout << "time offset " << runs[0].time_offset_s << " s added to the estimate's stamps\n";
  }
  std::cout << std::flush;
}

int Run(const Arguments& arguments) {
  if (!arguments.map.empty() && !std::filesystem::is_regular_file(arguments.map)) {
    return Fail(kExitUnusableInput, arguments.map + ": cannot be read; give a PCD file");
  }
  if (const std::string why = WhyNotScored(arguments); !why.empty()) {
    return Fail(kExitUnusableInput, why);
  }
  const Trajectory truth = ReadTrajectory(arguments.truth);
  std::vector<ScoredRun> runs;
  for (const std::string& run : arguments.estimates) {
    runs.push_back(ScoreRun(truth, run, ToOptions(arguments), ToWish(arguments)));
  }
  Print(arguments, runs);
  WriteFigures(arguments, runs);
  return Draw(arguments, runs[0].evaluation, {arguments.truth, runs[0].file});
}

int Main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "consistency") {
    return ConsistencyMain(argc - 1, argv + 1);
  }
  CLI::App app("Measures how far an estimated trajectory is from the truth.", kProgram);
  Arguments arguments;
  Describe(app, arguments);
  if (const auto exit_code = ParseCommandLine(app, argc, argv, LIO_VERSION)) return *exit_code;
  return Run(arguments);
}

}  // namespace
}  // namespace lio

int main(int argc, char** argv) {
  return lio::RunProgram(lio::kProgram, [&] { return lio::Main(argc, argv); });
}
