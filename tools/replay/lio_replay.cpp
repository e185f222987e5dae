// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// lio-replay: runs the estimator over a log, without a clock and without dropping anything.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>

#include "lio/io/beam_table.hpp"
#include "lio/io/command_line.hpp"
#include "lio/io/cpu_clock.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/log_input.hpp"
#include "lio/io/map_cloud.hpp"
#include "lio/io/progress_bar.hpp"
#include "lio/io/run_writer.hpp"
#include "lio/io/verdict_report.hpp"
#include "lio/pipeline/registration_worker.hpp"

namespace lio {
namespace {

struct ReplayArguments {
  OptionsArguments options;
  std::string log;
  std::string out;
  std::string channel_prefix = kDefaultChannelPrefix;
  std::optional<int> num_threads;
  bool writes_map = false;
  std::string map_format = "pcd";
  double start_s = 0.0;
  double duration_s = std::numeric_limits<double>::infinity();
  int match_lag = 0;
};

constexpr const char* kDescription =
    "Runs LiDAR-inertial odometry over an LCM log, as fast as the machine goes.\n\n"
    "Writes into DIR, with one row per scan: trajectory_level.tum (the path as it looks when the\n"
    "run is over: steady, and level by the last estimate), trajectory.tum (as it was published on\n"
    "LIO_ODOM_LOCAL: the pose of imu in map, which never turns), trajectory_world.tum (as on\n"
    "LIO_ODOM: always level), the covariance*.csv of each; then trajectory_imu_rate.tum,\n"
    "registration.csv, stats.json, verdict.json (may the result be trusted, and if not, why),\n"
    "options.yaml, map.pcd with --map, and trajectory_base.tum when the rig has T_base_imu. A\n"
    "summary of the verdict goes to stdout.\n"
    "The same log and options give the same files byte for byte, except for computing times.";

constexpr const char* kExamples =
    "Examples:\n"
    "  lio-replay --config config/ulhk.yaml drive.lcm --out out/drive\n"
    "  lio-replay --config config/ulhk.yaml --set pipeline.use_imu=false drive.lcm --out "
    "out/lidar\n"
    "  lio-replay --config config/default.yaml --config my_rig.yaml drive.lcm --out out --map\n\n"
    "Exit codes: 0 done, 2 usage, 3 configuration (also one that the log's data contradict),\n"
    "5 damaged, missing or unusable log, 6 done, but the result cannot be trusted: verdict.json\n"
    "and the summary on stdout say why and what to put into the configuration.";

void AddArguments(CLI::App& app, ReplayArguments& arguments) {
  app.footer(kExamples);
  app.add_option("LOG", arguments.log, "LCM log with LIO_IMU and LIO_SCAN")
      ->type_name("IN.lcm")
      ->required();
  app.add_option("--out", arguments.out, "Folder for the results; created when it is missing")
      ->type_name("DIR")
      ->required();
  app.add_option("--threads", arguments.num_threads,
                 "Instead of pipeline.num_threads; 2 or more also read and decode the log ahead")
      ->type_name("N")
      ->check(CLI::Range(1, 64));
  app.add_flag("--map", arguments.writes_map, "Write map.pcd with one point per voxel of 0.2 m");
  app.add_option("--map-format", arguments.map_format,
                 "Of the map: pcd, or ply to have map.ply in place of map.pcd")
      ->needs("--map")
      ->check(CLI::IsMember({"pcd", "ply"}))
      ->capture_default_str();
  app.add_option("--start", arguments.start_s, "Leave out the log's first S seconds")
      ->type_name("S")
      ->check(NumberFromZero());
  app.add_option("--duration", arguments.duration_s, "Replay only S seconds")
      ->type_name("S")
      ->check(NumberAboveZero());
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

// Feeds the estimator and carries its outputs to the files.
class Replay {
 public:
  Replay(const Options& options, const ReplayArguments& arguments, RunWriter& writer)
      : writer_(writer),
        odometry_(options, ThreadCpuNs),
        worker_(options, ThreadCpuNs, BeamElevations(options.rig.lidar.model)),
        writes_map_(arguments.writes_map),
        map_format_(arguments.map_format == "ply" ? MapFormat::kPly : MapFormat::kPcd),
        match_lag_(arguments.match_lag) {}

  void Run(LogInput& input) {
    const auto begin = std::chrono::steady_clock::now();
    ProgressBar bar("lio-replay", input.size_bytes());
    while (std::optional<InputItem> item = input.Next()) {
      bar.Update(item->position_bytes);
      Add(std::move(*item));
      if (refusal_.empty()) continue;
      verdict_ = odometry_.Judge();
      return;
    }
    odometry_.Flush();
    match_lag_ = 0;
    num_messages_to_wait_ = 0;
    Match();
    verdict_ = odometry_.Judge();
    Finish(input, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }

  const Counters& counters() const { return odometry_.counters(); }
  // After Run only.
  const Verdict& verdict() const { return verdict_; }
  // Says why the configuration contradicts the log; empty when it does not.
  const std::string& refusal() const { return refusal_; }

 private:
  void Add(InputItem item) {
    // The time of decoding inertial samples counts for the scan they come with.
    decode_ns_ += item.decode_ns;
    if (const auto* sample = std::get_if<ImuSample>(&item.data)) {
      odometry_.AddImu(*sample);
    } else {
      odometry_.AddChunk(std::get<ScanChunk>(std::move(item.data)), decode_ns_);
      decode_ns_ = 0;
    }
    --num_messages_to_wait_;
    Match();
  }

  void Match() {
    while (outcome_ || StartMatch()) {
      if (num_messages_to_wait_ > 0) break;
      const InsertTask insert = odometry_.FinishJob(*std::exchange(outcome_, std::nullopt));
      worker_.Insert(insert);
      if (writes_map_ && insert.T_map_imu) map_.Add(insert.points_imu, *insert.T_map_imu);
    }
    TakeOutputs();
  }

  bool StartMatch() {
    const std::optional<MatchJob> job = odometry_.NextJob();
    if (!job) return false;
    if (job->map_action == MapAction::kClear) map_.Clear();
    outcome_ = worker_.Run(*job);
    num_messages_to_wait_ = match_lag_;
    return true;
  }

  void TakeOutputs() {
    for (const Output& output : odometry_.TakeOutputs()) {
      writer_.Write(output);
      if (const auto* notice = std::get_if<Notice>(&output)) {
        if (notice->severity == Notice::Severity::kError) {
          refusal_ = notice->text;
          continue;
        }
        fmt::print(stderr, "lio-replay: {:.3f}: {}\n", static_cast<double>(notice->stamp.ns) * 1e-9,
                   notice->text);
      }
    }
  }

  void Finish(const LogInput& input, double wall_s) {
    if (writes_map_) writer_.WriteMap(map_.points_map(), map_format_);
    RunStats stats;
    stats.counters = odometry_.counters();
    stats.input = input.counters();
    stats.num_skipped_bytes = input.num_skipped_bytes();
    stats.log_duration_s = input.duration_s();
    stats.wall_s = wall_s;
    stats.verdict = verdict_;
    writer_.Finish(stats);
  }

  RunWriter& writer_;
  Odometry odometry_;
  RegistrationWorker worker_;
  MapCloud map_;
  bool writes_map_;
  MapFormat map_format_;
  int match_lag_;
  std::optional<MatchOutcome> outcome_;  // of the last match, until it is taken
  int num_messages_to_wait_ = 0;         // messages to read before it is taken
  std::int64_t decode_ns_ = 0;
  std::string refusal_;
  Verdict verdict_;
};

// Says in one line what was wrong with the log; empty when nothing was.
std::string Complaint(const LogInput& input, const Counters& counters,
                      const ReplayArguments& arguments) {
  if (counters.num_chunks == 0) {
    const bool is_whole = arguments.start_s == 0.0 && std::isinf(arguments.duration_s);
    return fmt::format(
        "{} has no scans on {}SCAN{}: nothing to estimate; see what it holds with 'lio-log info'",
        arguments.log, arguments.channel_prefix,
        is_whole ? "" : " in the part that --start and --duration leave");
  }
  std::string text;
  if (input.num_skipped_bytes() > 0) {
    text = fmt::format("skipped {} damaged bytes", input.num_skipped_bytes());
  }
  if (const std::int64_t refused = input.counters().TotalRefused(); refused > 0) {
    text += fmt::format("{}refused {} undecodable messages", text.empty() ? "" : " and ", refused);
  }
  return text.empty() ? text : fmt::format("{}: {}; the rest was replayed", arguments.log, text);
}

// Tells how the run went; the exit code.
ExitCode End(const LogInput& input, const Replay& replay, const ReplayArguments& arguments) {
  if (!replay.refusal().empty()) {
    WriteVerdict(arguments.out, replay.verdict());
    fmt::print(stderr, "lio-replay: {}\n", replay.refusal());
    return kExitConfiguration;
  }
  fmt::print("{}", VerdictSummary(replay.verdict()));
  const std::string complaint = Complaint(input, replay.counters(), arguments);
  if (complaint.empty()) return replay.verdict().trust == Trust::kNo ? kExitNoTrust : kExitDone;
  fmt::print(stderr, "lio-replay: {}\n", complaint);
  return kExitUnusableInput;
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
  LogInput input(arguments.log, input_options);
  std::optional<RunWriter> writer;
  try {
    writer.emplace(arguments.out, options);
  } catch (const std::runtime_error& error) {
    fmt::print(stderr, "lio-replay: --out: {}\n", error.what());
    return kExitUsage;
  }
  Replay replay(options, arguments, *writer);
  replay.Run(input);
  return End(input, replay, arguments);
}

}  // namespace
}  // namespace lio

int main(int argc, char** argv) {
  try {
    return lio::Main(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "lio-replay: {}\n", error.what());
    return lio::kExitUnusableInput;
  }
}
