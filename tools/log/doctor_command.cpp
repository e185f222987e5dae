// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// lio-log doctor: says what is wrong with a rig, and what mends it (docs/report.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "commands.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/input_guard.hpp"
#include "lio/io/options_yaml.hpp"
#include "lio/io/output_file.hpp"
#include "lio/io/progress_bar.hpp"
#include "lio/run/diagnosis_report.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAboutDoctor =
    "Says what is wrong with a sensor set-up: runs odometry over a recording and lists all causes\n"
    "for doubt, likeliest first, each with its sigma, the evidence and the lines that mend it. "
    "The\n"
    "fix of the likeliest is laid over the rig and the recording replayed to see what it gives.\n"
    "INPUT is all that lio-run takes: an LCM log, a ROS 1 or ROS 2 bag, an MCAP file, a KITTI "
    "drive.\n"
    "Without --config the rig is that beside the log, else one is drafted. Files on the way (the\n"
    "log of a bag among them) stand in the folder for temporary files, see TMPDIR, and are "
    "removed.\n\n"
    "Examples:\n"
    "  lio-log doctor drive.lcm --config my_rig.yaml\n"
    "  lio-log doctor drive.bag --write-rig rig.yaml\n\n"
    "Exit codes: 0 done, also where trust is doubtful; 6 where no trust is left.";

// A folder for the files that are made on the way.
class WorkFolder {
 public:
  WorkFolder() {
    std::string pattern = (fs::temp_directory_path() / "lio-doctor-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
      throw OutputError(pattern + ": cannot be made; TMPDIR may name another place");
    }
    path_ = pattern;
  }
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::optional<std::string> IfGiven(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

Diagnosis Examine(const DoctorArguments& arguments) {
  const WorkFolder folder;
  DiagnosisRequest request;
  request.recording.input = arguments.input;
  request.recording.out = folder.path();
  request.recording.lidar_topic = IfGiven(arguments.lidar_topic);
  request.recording.imu_topic = IfGiven(arguments.imu_topic);
  request.rig_files = arguments.options.files;
  request.sets = arguments.options.sets;
  request.program = "lio-log";
  request.num_threads = arguments.num_threads;
  request.start_s = arguments.start_s;
  request.duration_s = arguments.duration_s;
  request.max_passes = arguments.num_passes;
  constexpr std::int64_t kSteps = 1000;
  ProgressBar bar("convert", kSteps);
  request.recording.progress = [&bar](double share) {
    bar.Update(static_cast<std::int64_t>(share * static_cast<double>(kSteps)));
  };
  return Diagnose(request);
}

}  // namespace

CLI::App* AddDoctorCommand(CLI::App& app, DoctorArguments& arguments) {
  CLI::App* command = app.add_subcommand("doctor", kAboutDoctor);
  command->add_option("INPUT", arguments.input, "Recording of any kind that lio-run takes")
      ->required();
  command->add_option("--json", arguments.json_file, "Write the diagnosis as JSON too")
      ->type_name("FILE");
  command
      ->add_option("--write-rig", arguments.rig_file, "Write the rig with the fixes that are sure")
      ->type_name("OUT.yaml");
  command
      ->add_option("--passes", arguments.num_passes,
                   "Replay at most this many times: the first with the rig as it is, the others "
                   "with fixes; with 1 the first fix is taken unseen")
      ->type_name("N")
      ->check(CLI::Range(1, 10))
      ->capture_default_str();
  command->add_option("--lidar-topic", arguments.lidar_topic, "Topic of a bag's PointCloud2")
      ->type_name("NAME");
  command->add_option("--imu-topic", arguments.imu_topic, "Topic of a bag's Imu")
      ->type_name("NAME");
  command->add_option("--threads", arguments.num_threads, "Instead of pipeline.num_threads")
      ->type_name("N")
      ->check(CLI::Range(1, 64));
  AddSpanArguments(*command, arguments.start_s, arguments.duration_s);
  AddOptionsArguments(*command, arguments.options);
  return command;
}

int RunDoctor(const DoctorArguments& arguments) {
  if (arguments.options.print) {
    const LoadResult loaded = LoadOptions(arguments.options.files, arguments.options.sets);
    fmt::print("{}", PrintOptions(loaded.options));
    for (const std::string& fault : loaded.faults) fmt::print(stderr, "lio-log: {}\n", fault);
    return loaded.faults.empty() ? kExitDone : kExitConfiguration;
  }
  Paths inputs = arguments.options.files;
  inputs.emplace_back(arguments.input);
  RefuseToOverwrite(inputs, {arguments.json_file, arguments.rig_file});
  const Diagnosis diagnosis = Examine(arguments);
  for (const std::string& fault : diagnosis.faults) fmt::print(stderr, "lio-log: {}\n", fault);
  if (!diagnosis.faults.empty()) return kExitConfiguration;
  fmt::print("{}", DiagnosisText(diagnosis, arguments.input));
  if (!arguments.json_file.empty()) {
    WriteText(arguments.json_file, DiagnosisJson(diagnosis, arguments.input),
              OutputFile::Links::kFollowed);
  }
  if (!arguments.rig_file.empty()) {
    WriteText(arguments.rig_file, DiagnosedRigYaml(diagnosis, arguments.input),
              OutputFile::Links::kFollowed);
  }
  if (diagnosis.recording.is_damaged) {
    fmt::print(stderr, "lio-log: {} is damaged: its sound parts were looked at\n", arguments.input);
  }
  if (!diagnosis.complaint.empty()) fmt::print(stderr, "lio-log: {}\n", diagnosis.complaint);
  if (diagnosis.recording.is_damaged || !diagnosis.complaint.empty()) return kExitUnusableInput;
  return diagnosis.verdict.trust == Trust::kNo ? kExitNoTrust : kExitDone;
}

}  // namespace lio
