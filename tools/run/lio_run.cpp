// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// lio-run: a recording of any kind to a path, a verdict and a page with plots.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "lio/io/command_line.hpp"
#include "lio/io/cpu_clock.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/options_yaml.hpp"
#include "lio/io/output_file.hpp"
#include "lio/io/program.hpp"
#include "lio/io/progress_bar.hpp"
#include "lio/io/verdict_report.hpp"
#include "lio/run/finish_run.hpp"
#include "lio/run/recording.hpp"
#include "lio/run/replay.hpp"
#include "page_commands.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "lio-run";

struct Arguments {
  std::vector<std::string> inputs;
  std::string input;  // the first of them
  std::string out;
  std::string rig;
  std::string truth;
  std::string lidar_topic, imu_topic, truth_topic, imu_file;
  OptionsArguments options;
  std::optional<int> num_threads;
  double start_s = 0.0;
  double duration_s = std::numeric_limits<double>::infinity();
  bool overwrites = false;
};

constexpr const char* kAbout =
    "Runs odometry over a recording of any kind and leaves a folder with the result.\n\n"
    "INPUT is recognised by its content: a ROS 1 bag (or the folder of its parts), a ROS 2 bag "
    "(its\n"
    "folder, one .db3 or one .mcap), a pcap of Velodyne or Ouster packets, a KITTI raw drive, a "
    "KITTI odometry sequence, an LCM log, or "
    "a folder\n"
    "that lio-sim wrote. It is converted, replayed, and scored where there is a truth. DIR then "
    "has\n"
    "all that 'lio-replay --map' writes, report.html (plots of all that matters, for any browser,\n"
    "no network needed), the log and conversion.txt of what was no log, and with a truth eval.txt\n"
    "and eval.json.\n\n"
    "Without --rig a rig is drafted from what the recording shows, as DIR/rig_draft.yaml: the "
    "lidar\n"
    "by its beams, the extrinsic from /tf_static, else none; what is assumed is told. The rig of\n"
    "another vehicle is never taken. Correct the draft and run again with --rig; where the "
    "verdict\n"
    "knows the right lines, DIR/rig_corrected.yaml has them already.\n\n"
    "A run's folder as INPUT gets its report.html anew. Several such folders make one page that\n"
    "compares them, DIR/report.html.";

constexpr const char* kExamples =
    "Examples:\n"
    "  lio-run drive.bag --out out/drive\n"
    "  lio-run drive.bag --rig out/drive/rig_draft.yaml --out out/drive --overwrite\n"
    "  lio-run ros2_folder --lidar-topic /velodyne_points --truth truth.tum --out out/ros2\n"
    "  lio-run 2011_09_26/2011_09_26_drive_0005_sync --out out/kitti\n"
    "  lio-run out/live --truth truth.tum\n"
    "  lio-run out/loam out/gicp --out out/compared\n\n"
    "Exit codes: 0 done, 2 usage (also an ambiguous topic), 3 configuration (also one that the "
    "data\n"
    "contradict), 5 damaged, missing or unusable input (its sound parts were run), 6 done, but "
    "the\n"
    "result cannot be trusted: verdict.json, the summary and the page say why and what to change,\n"
    "74 a file or stdout could not be written in full.";

void AddArguments(CLI::App& app, Arguments& arguments) {
  app.footer(kExamples);
  app.add_option("INPUT", arguments.inputs,
                 "Recording, or the folder of a finished run; several such folders make one page")
      ->required();
  app.add_option("--out", arguments.out, "Folder for the results; it must be empty or new")
      ->type_name("DIR");
  app.add_flag("--overwrite", arguments.overwrites, "Replace the files of an earlier run in DIR");
  app.add_option("--rig", arguments.rig,
                 "The vehicle's configuration, which --config overrides (default: a draft is made)")
      ->type_name("FILE");
  app.add_option("--truth", arguments.truth,
                 "True trajectory as TUM file (default: beside INPUT, else from it)")
      ->type_name("FILE")
      ->check(CLI::ExistingFile.description(""));
  app.add_option("--lidar-topic", arguments.lidar_topic,
                 "Topic of a bag's PointCloud2 or CustomMsg, or a capture's sensor, ADDRESS:PORT")
      ->type_name("NAME");
  app.add_option("--imu-topic", arguments.imu_topic, "Topic of a bag's Imu")->type_name("NAME");
  app.add_option("--imu", arguments.imu_file,
                 "Log, bag or table of the IMU beside a network capture (default: DRIVE.imu.*)")
      ->type_name("FILE");
  app.add_option("--truth-topic", arguments.truth_topic, "Topic of a bag's truth")
      ->type_name("NAME");
  app.add_option("--threads", arguments.num_threads, "Instead of pipeline.num_threads")
      ->type_name("N")
      ->check(CLI::Range(1, 64));
  AddSpanArguments(app, arguments.start_s, arguments.duration_s);
  AddOptionsArguments(app, arguments.options);
}

std::optional<std::string> IfGiven(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

std::optional<fs::path> TruthArgument(const Arguments& arguments) {
  if (arguments.truth.empty()) return std::nullopt;
  return fs::path(arguments.truth);
}

// Files of an earlier run are removed, and what lies beside the input is no such file.
bool HoldsInput(const fs::path& out, const fs::path& input) {
  std::error_code ignored;
  const fs::path around = fs::absolute(input / "").parent_path().parent_path();
  return fs::equivalent(out, input, ignored) || fs::equivalent(out, around, ignored);
}

// Makes the folder, or refuses one that holds something.
void PrepareFolder(const Arguments& arguments) {
  if (arguments.out.empty()) {
    throw UsageError("--out is required: name a folder for the results (see --help)");
  }
  const fs::path out = arguments.out;
  std::error_code error;
  if (fs::is_directory(out, error)) {
    if (HoldsInput(out, arguments.input)) {
      throw UsageError(out.string() + ": holds the input; name another folder");
    }
    if (!fs::is_empty(out, error) && !arguments.overwrites) {
      throw UsageError(out.string() +
                       ": exists and is not empty; name another folder or add --overwrite");
    }
    for (const char* name : {"log.lcm", "truth.tum"}) {
      if (KindOf(arguments.input) == FileKind::kLcmLog) break;  // it is only read
      RefuseToOverwrite(arguments.input, out / name);
      if (fs::is_symlink(out / name)) fs::remove(out / name);  // its target is another's
    }
    RemoveStaleFiles(out, {arguments.truth, arguments.rig});
    return;
  }
  fs::create_directories(out, error);
  if (error) throw UsageError("--out: cannot create " + out.string() + ": " + error.message());
}

PreparedRecording Prepare(const Arguments& arguments) {
  RecordingRequest request;
  request.input = arguments.input;
  request.out = arguments.out;
  request.truth = TruthArgument(arguments);
  request.lidar_topic = IfGiven(arguments.lidar_topic);
  request.imu_topic = IfGiven(arguments.imu_topic);
  request.truth_topic = IfGiven(arguments.truth_topic);
  if (!arguments.imu_file.empty()) request.imu_file = arguments.imu_file;
  request.needs_rig = arguments.rig.empty();
  constexpr std::int64_t kSteps = 1000;
  ProgressBar bar("convert", kSteps);
  request.progress = [&bar](double share) {
    bar.Update(static_cast<std::int64_t>(share * static_cast<double>(kSteps)));
  };
  return PrepareRecording(request);
}

std::vector<fs::path> ConfigurationFiles(const Arguments& arguments,
                                         const PreparedRecording& recording) {
  std::vector<fs::path> files = recording.rig_files;
  if (!arguments.rig.empty()) files.emplace_back(arguments.rig);
  files.insert(files.end(), arguments.options.files.begin(), arguments.options.files.end());
  return files;
}

bool IsDrafted(const PreparedRecording& recording) {
  return !recording.rig_files.empty() && recording.rig_files[0].filename() == "rig_draft.yaml";
}

void TellInput(const Arguments& arguments, const PreparedRecording& recording) {
  fmt::print("input       {} ({})\n", arguments.input, recording.kind);
  if (!recording.report.empty()) {
    const fs::path file = fs::path(arguments.out) / "conversion.txt";
    WriteText(file, recording.report);
    fmt::print("converted   {} ({:.0f} MB; it may be deleted), told in {}\n",
               recording.log.string(), static_cast<double>(fs::file_size(recording.log)) * 1e-6,
               file.string());
  }
  for (const std::string& sentence : recording.assumptions)
    fmt::print("assumed     {}\n", sentence);
  if (IsDrafted(recording)) {
    fmt::print("rig         {}: drafted; correct it, then give it as --rig\n",
               recording.rig_files[0].string());
  }
  std::fflush(stdout);
}

std::string NextCommand(const Arguments& arguments, const fs::path& rig) {
  std::string command = fmt::format("{} {} --rig {} --out {} --overwrite", kProgram,
                                    arguments.input, rig.string(), arguments.out);
  const std::vector<std::pair<const char*, const std::string*>> options = {
      {"--truth", &arguments.truth},
      {"--lidar-topic", &arguments.lidar_topic},
      {"--imu-topic", &arguments.imu_topic},
      {"--imu", &arguments.imu_file},
      {"--truth-topic", &arguments.truth_topic}};
  for (const auto& [name, value] : options) {
    if (!value->empty()) command += fmt::format(" {} {}", name, *value);
  }
  return command;
}

void TellResult(const Arguments& arguments, const PreparedRecording& recording,
                const Verdict& verdict) {
  const fs::path out = arguments.out;
  if (recording.truth) {
    const Score score = ScoreRun(out, *recording.truth);
    fmt::print("{}{}\n", score.is_scored ? "score       " : "no score    ", score.line);
  } else {
    fmt::print("no score    there is no truth; give one with --truth\n");
  }
  fmt::print("path        {}\n", PathOfRun(out).string());
  try {
    WriteReport(out, {arguments.input, recording.truth, recording.assumptions});
    fmt::print("report      {}\n", (out / kReportFile).string());
  } catch (const WriteError&) {
    throw;
  } catch (const std::runtime_error& error) {  // the result itself is sound
    fmt::print(stderr, "{}: no report: {}\n", kProgram, error.what());
  }
  fmt::print("{}", VerdictSummary(verdict));
  if (!IsDrafted(recording)) return;
  if (const auto corrected = WriteCorrectedRig(out, recording.rig_files, verdict)) {
    fmt::print("next        {}\n", NextCommand(arguments, *corrected));
  }
}

ExitCode Run(const Arguments& arguments, const PreparedRecording& recording, Options options) {
  if (arguments.num_threads) options.pipeline.num_threads = *arguments.num_threads;
  LogInputOptions input_options;
  input_options.start_s = arguments.start_s;
  input_options.duration_s = arguments.duration_s;
  input_options.clock = ThreadCpuNs;
  input_options.reads_ahead = options.pipeline.num_threads > 1;
  LogInput input(recording.log, input_options);
  RunWriter writer(arguments.out, options);
  ReplaySettings settings;
  settings.program = kProgram;
  settings.writes_map = true;
  Replay replay(options, settings, writer);
  replay.Run(input);
  if (writer.failure()) {
    fmt::print("{}", VerdictSummary(replay.verdict()));
    return kExitWriteFailed;
  }
  if (!replay.refusal().empty()) {
    WriteVerdict(arguments.out, replay.verdict());
    fmt::print(stderr, "{}: {}\n", kProgram, replay.refusal());
    return kExitConfiguration;
  }
  const std::string complaint =
      LogComplaint(recording.log.string(), input, replay.counters(), input_options);
  TellResult(arguments, recording, replay.verdict());
  if (!complaint.empty()) fmt::print(stderr, "{}: {}\n", kProgram, complaint);
  if (recording.is_damaged) {
    fmt::print(stderr, "{}: {} is damaged: its sound parts were run, see {}\n", kProgram,
               arguments.input, (fs::path(arguments.out) / "conversion.txt").string());
  }
  if (!complaint.empty() || recording.is_damaged) return kExitUnusableInput;
  return replay.verdict().trust == Trust::kNo ? kExitNoTrust : kExitDone;
}

int Main(int argc, char** argv) {
  CLI::App app(kAbout, kProgram);
  Arguments arguments;
  AddArguments(app, arguments);
  if (const auto code = ParseCommandLine(app, argc, argv, LIO_VERSION)) return *code;
  arguments.input = arguments.inputs.front();
  if (!arguments.options.print) {
    const PageArguments pages = {arguments.inputs, arguments.out, TruthArgument(arguments),
                                 arguments.overwrites};
    if (const auto code = WritePages(pages)) return *code;
  }
  PreparedRecording recording;
  if (!arguments.options.print) {
    PrepareFolder(arguments);
    recording = Prepare(arguments);
    TellInput(arguments, recording);
  }
  const LoadResult loaded =
      LoadOptions(ConfigurationFiles(arguments, recording), arguments.options.sets);
  if (arguments.options.print) fmt::print("{}", PrintOptions(loaded.options));
  for (const std::string& fault : loaded.faults) fmt::print(stderr, "{}: {}\n", kProgram, fault);
  if (!loaded.faults.empty()) return kExitConfiguration;
  return arguments.options.print ? kExitDone : Run(arguments, recording, loaded.options);
}

}  // namespace
}  // namespace lio

int main(int argc, char** argv) {
  return lio::RunProgram(lio::kProgram, [&] { return lio::Main(argc, argv); });
}
