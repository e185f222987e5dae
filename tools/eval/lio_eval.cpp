// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// lio-eval: measures how far a trajectory is from the truth; and lio-eval consistency.
#include <CLI/CLI.hpp>
#include <iostream>
#include <string_view>

#include "eval_program.hpp"
#include "lio/eval/evaluation.hpp"
#include "lio/eval/report.hpp"
#include "lio/io/command_line.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "plot_runner.hpp"

namespace lio {
namespace {

constexpr char kFooter[] = R"(
Files are TUM (t x y z qx qy qz qw) or KITTI (12 numbers per row); the format is detected.
docs/evaluation.md explains each figure.

Examples:
  lio-eval truth.tum out/trajectory.tum
  lio-eval truth.tum out/trajectory.tum --json out/eval.json --plot out/eval.png --map out/map.pcd
  lio-eval poses/05.txt mine.txt --align none
  lio-eval consistency --help                     to judge the covariance

Exit codes: 0 done, 2 usage, 3 no matplotlib for the pictures, 5 missing or unusable input.)";

struct Arguments {
  std::string truth;
  std::string estimate;
  std::string align = "se3";
  std::optional<double> max_gap_s;
  std::string json;
  std::string plot;
  std::string plots;
  std::string map;
};

void Describe(CLI::App& app, Arguments& arguments) {
  app.add_option("TRUTH", arguments.truth, "True trajectory")->required()->type_name("FILE");
  app.add_option("ESTIMATE", arguments.estimate, "Estimated trajectory")
      ->required()
      ->type_name("FILE");
  app.add_option("--align", arguments.align,
                 "Move the estimate onto the truth: not at all, about z, or freely (default se3)")
      ->check(CLI::IsMember({"none", "yaw", "se3"}).description(""))
      ->type_name("none|yaw|se3");
  app.add_option("--max-gap", arguments.max_gap_s,
                 "Interpolate across gaps of at most so many seconds (default: from the data)")
      ->check(NumberAboveZero())
      ->type_name("S");
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

int Run(const Arguments& arguments) {
  if (!arguments.map.empty() && !std::filesystem::is_regular_file(arguments.map)) {
    return Fail(kExitUnusableInput, arguments.map + ": cannot be read; give a PCD file");
  }
  try {
    for (const std::string& file : {arguments.truth, arguments.estimate}) {
      if (!arguments.json.empty()) RefuseToOverwrite(file, arguments.json);
      if (const std::string why = WhyNoTrajectory(file); !why.empty()) {
        return Fail(kExitUnusableInput, why);
      }
    }
    const Trajectory truth = ReadTrajectory(arguments.truth);
    const Trajectory estimate = ReadTrajectory(arguments.estimate);
    const Evaluation evaluation = Evaluate(truth, estimate, ToOptions(arguments));
    const ReportedFiles files = {arguments.truth, arguments.estimate};
    std::cout << EvaluationText(evaluation, files) << std::flush;
    if (!arguments.json.empty()) {
      const int exit_code = WriteJson(arguments.json, EvaluationJson(evaluation, files));
      if (exit_code != kExitDone) return exit_code;
    }
    return Draw(arguments, evaluation, files);
  } catch (const UsageError& e) {
    return Fail(kExitUsage, e.what());
  } catch (const std::runtime_error& e) {
    return Fail(kExitUnusableInput, e.what());
  }
}

}  // namespace
}  // namespace lio

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "consistency") {
    return lio::ConsistencyMain(argc - 1, argv + 1);
  }
  CLI::App app("Measures how far an estimated trajectory is from the truth.", lio::kProgram);
  lio::Arguments arguments;
  lio::Describe(app, arguments);
  if (const auto exit_code = lio::ParseCommandLine(app, argc, argv, LIO_VERSION)) return *exit_code;
  return lio::Run(arguments);
}
