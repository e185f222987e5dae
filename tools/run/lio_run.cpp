// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// lio-run turns a recording of any kind into a path, a verdict and a page with plots.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "lio/io/cpu_clock.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/input_guard.hpp"
#include "lio/io/options_yaml.hpp"
#include "lio/io/output_file.hpp"
#include "lio/io/program.hpp"
#include "lio/io/progress_bar.hpp"
#include "lio/io/run_folder.hpp"
#include "lio/io/verdict_report.hpp"
#include "lio/run/finish_run.hpp"
#include "lio/run/passes.hpp"
#include "lio/run/recording.hpp"
#include "page_commands.hpp"
#include "run_arguments.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "lio-run";

std::optional<std::string> IfGiven(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

std::optional<fs::path> TruthArgument(const RunArguments& arguments) {
  if (arguments.truth.empty()) return std::nullopt;
  return fs::path(arguments.truth);
}

// Files of an earlier run are removed, and what lies beside the input is no such file.
bool HoldsInput(const fs::path& out, const fs::path& input) {
  std::error_code ignored;
  const fs::path around = fs::absolute(input / "").parent_path().parent_path();
  return fs::equivalent(out, input, ignored) || fs::equivalent(out, around, ignored);
}

// Refuses a folder in which the run would replace a file that it reads. A rig or a truth of an
// earlier run may be read again: without --rig alone a draft is made, and with --truth none is
// converted but that of a KITTI drive.
void GuardInputs(const RunArguments& arguments) {
  const fs::path out = arguments.out;
  const std::vector<fs::path>& configs = arguments.options.files;
  Paths written = FilesOfRun(out);
  for (const char* name :
       {"log.lcm", "conversion.txt", "eval.txt", "eval.json", "kitti_rig.yaml"}) {
    written.push_back(out / name);
  }
  if (KindOf(arguments.input()) == FileKind::kLcmLog) std::erase(written, out / "log.lcm");
  const Paths kept = {out / "truth.tum", out / "rig_draft.yaml", out / "rig_corrected.yaml"};
  Paths inputs = configs;
  inputs.insert(inputs.end(), {arguments.input(), arguments.imu_file});
  RefuseToOverwrite(inputs, kept);
  inputs.insert(inputs.end(), {arguments.rig, arguments.truth});
  RefuseToOverwrite(inputs, written);
  const FileKind kind = KindOf(arguments.input());
  if (kind == FileKind::kKittiRaw || kind == FileKind::kKittiOdometry) {
    RefuseToOverwrite({arguments.truth}, {out / "truth.tum"});
  }
}

// Makes the folder, or refuses one that holds something.
void PrepareFolder(const RunArguments& arguments) {
  if (arguments.out.empty()) {
    throw UsageError("--out is required: name a folder for the results (see --help)");
  }
  const fs::path out = arguments.out;
  std::error_code error;
  if (fs::is_directory(out, error)) {
    if (HoldsInput(out, arguments.input())) {
      throw UsageError(out.string() + ": holds the input; name another folder");
    }
    if (!fs::is_empty(out, error) && !arguments.overwrites) {
      throw UsageError(out.string() +
                       ": exists and is not empty; name another folder or add --overwrite");
    }
    GuardInputs(arguments);
    for (const char* name : {"log.lcm", "truth.tum"}) {
      if (KindOf(arguments.input()) == FileKind::kLcmLog) break;  // it is only read
      if (fs::is_symlink(out / name)) fs::remove(out / name);     // its target is another's
    }
    RemoveStaleFiles(out, {arguments.truth, arguments.rig});
    return;
  }
  MakeFolder(out);
}

PreparedRecording Prepare(const RunArguments& arguments) {
  RecordingRequest request;
  request.input = arguments.input();
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

std::vector<fs::path> ConfigurationFiles(const RunArguments& arguments,
                                         const PreparedRecording& recording) {
  std::vector<fs::path> files = recording.rig_files;
  if (!arguments.rig.empty()) files.emplace_back(arguments.rig);
  files.insert(files.end(), arguments.options.files.begin(), arguments.options.files.end());
  return files;
}

bool IsDrafted(const PreparedRecording& recording) {
  return !recording.rig_files.empty() && recording.rig_files[0].filename() == "rig_draft.yaml";
}

void TellInput(const RunArguments& arguments, const PreparedRecording& recording) {
  fmt::print("input       {} ({})\n", arguments.input(), recording.kind);
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

// Nobody has told where the lidar sits, neither the recording nor the configuration.
bool IsMountingAssumed(const PreparedRecording& recording, const Rig& rig) {
  const bool is_identity = !rig.T_imu_lidar || (rig.T_imu_lidar->translation.isZero(0.0) &&
                                                rig.T_imu_lidar->rotation.vec().isZero(0.0));
  return recording.is_mounting_assumed && is_identity && !rig.T_base_imu;
}

std::string NextCommand(const RunArguments& arguments, const fs::path& rig) {
  std::string command = fmt::format("{} {} --rig {} --out {} --overwrite", kProgram,
                                    arguments.input(), rig.string(), arguments.out);
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

void TellResult(const RunArguments& arguments, const PreparedRecording& recording,
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
    WriteReport(out, {arguments.input(), recording.truth, recording.assumptions});
    fmt::print("report      {}\n", (out / kReportFile).string());
  } catch (const WriteError&) {
    throw;
  } catch (const std::runtime_error& error) {  // the result itself is sound
    fmt::print(stderr, "{}: no report: {}\n", kProgram, error.what());
  }
  fmt::print("{}", VerdictSummary(verdict));
  if (!IsDrafted(recording)) return;
  const auto corrected = WriteCorrectedRig(out, recording.rig_files, verdict);
  if (!corrected) return;
  const auto has_fix = [](const Cause& cause) { return !cause.fix.empty(); };
  if (std::ranges::any_of(verdict.causes, has_fix)) {
    fmt::print("next        {}\n", NextCommand(arguments, *corrected));
  } else {
    fmt::print("rig         {}: corrected, for liod and other drives\n", corrected->string());
  }
}

ExitCode Run(const RunArguments& arguments, const PreparedRecording& recording, Options options) {
  if (arguments.num_threads) options.pipeline.num_threads = *arguments.num_threads;
  LogInputOptions input_options;
  input_options.start_s = arguments.start_s;
  input_options.duration_s = arguments.duration_s;
  input_options.clock = ThreadCpuNs;
  input_options.reads_ahead = options.pipeline.num_threads > 1;
  ReplaySettings settings;
  settings.program = kProgram;
  settings.writes_map = true;
  const PassesResult result =
      RunPasses({recording.log, input_options, options, settings, arguments.out,
                 arguments.num_passes, IsMountingAssumed(recording, options.rig)});
  if (!result.failure.empty()) {
    fmt::print("{}", VerdictSummary(result.verdict));
    return kExitWriteFailed;
  }
  if (!result.refusal.empty()) {
    WriteVerdict(arguments.out, result.verdict);
    fmt::print(stderr, "{}: {}\n", kProgram, result.refusal);
    return kExitConfiguration;
  }
  TellResult(arguments, recording, result.verdict);
  if (!result.complaint.empty()) fmt::print(stderr, "{}: {}\n", kProgram, result.complaint);
  if (recording.is_damaged) {
    fmt::print(stderr, "{}: {} is damaged: its sound parts were run, see {}\n", kProgram,
               arguments.input(), (fs::path(arguments.out) / "conversion.txt").string());
  }
  if (!result.failure_of_second.empty()) return kExitWriteFailed;
  if (!result.complaint.empty() || recording.is_damaged) return kExitUnusableInput;
  return result.verdict.trust == Trust::kNo ? kExitNoTrust : kExitDone;
}

int Main(int argc, char** argv) {
  CLI::App app(kAbout, kProgram);
  RunArguments arguments;
  AddArguments(app, arguments);
  if (const auto code = ParseCommandLine(app, argc, argv, LIO_VERSION)) return *code;
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
