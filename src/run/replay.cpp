// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/run/replay.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "lio/io/beam_table.hpp"
#include "lio/io/cpu_clock.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/progress_bar.hpp"

namespace lio {

Replay::Replay(const Options& options, const ReplaySettings& settings, RunWriter& writer,
               const FoundByReplay* found)
    : settings_(settings),
      writer_(writer),
      odometry_(options, ThreadCpuNs,
                settings.initial_map ? StartIn::kInitialMap : StartIn::kNewMap,
                found == nullptr ? nullptr : &found->sensors),
      worker_(options, ThreadCpuNs, BeamElevations(options.rig.lidar.model), settings.initial_map),
      lidar_check_(options) {
  if (found != nullptr) {
    if (found->beams) worker_.TakeCalibration(*found->beams);
    num_passes_ = 2;
  }
  if (settings_.writes_map && settings_.initial_map) {
    map_.AddSaved(settings_.initial_map->points);
  }
}

void Replay::Run(LogInput& input) {
  const auto begin = std::chrono::steady_clock::now();
  ProgressBar bar(settings_.program, input.size_bytes());
  while (std::optional<InputItem> item = input.Next()) {
    bar.Update(item->position_bytes);
    Add(std::move(*item));
    if (refusal_.empty()) continue;
    verdict_ = odometry_.Judge();
    return;
  }
  odometry_.Flush();
  settings_.match_lag = 0;
  num_messages_to_wait_ = 0;
  Match();
  Judge();
  Finish(input, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
}

FoundByReplay Replay::found() const {
  FoundByReplay found{odometry_.found_sensors(), std::nullopt};
  if (worker_.calibration().IsOfUseElsewhere()) found.beams = worker_.calibration();
  return found;
}

void Replay::Add(InputItem item) {
  // The time of decoding inertial samples counts for the scan they come with.
  decode_ns_ += item.decode_ns;
  if (const auto* sample = std::get_if<ImuSample>(&item.data)) {
    odometry_.AddImu(*sample);
  } else {
    lidar_check_.Add(std::get<ScanChunk>(item.data));
    odometry_.AddChunk(std::get<ScanChunk>(std::move(item.data)), decode_ns_);
    decode_ns_ = 0;
  }
  --num_messages_to_wait_;
  Match();
}

void Replay::Match() {
  while (outcome_ || StartMatch()) {
    if (num_messages_to_wait_ > 0) break;
    const InsertTask insert = odometry_.FinishJob(*std::exchange(outcome_, std::nullopt));
    worker_.Insert(insert);
    const bool grows_map = insert.T_map_imu && worker_.is_in_map();
    if (settings_.writes_map && grows_map) AddToMap(insert);
  }
  TakeOutputs();
}

void Replay::AddToMap(const InsertTask& insert) {
  const double voxel_m = map_.voxel_m();
  map_.Add(insert.points_imu, *insert.T_map_imu);
  if (map_.voxel_m() > voxel_m) fmt::print(stderr, "{}: {}\n", settings_.program, map_.thinned());
}

bool Replay::StartMatch() {
  const std::optional<MatchJob> job = odometry_.NextJob();
  if (!job) return false;
  if (job->map_action == MapAction::kClear && !settings_.initial_map) map_.Clear();
  outcome_ = worker_.Run(*job);
  num_messages_to_wait_ = settings_.match_lag;
  return true;
}

void Replay::TakeOutputs() {
  for (const Output& output : odometry_.TakeOutputs()) {
    writer_.Write(output);
    TellFailure();
    if (const auto* notice = std::get_if<Notice>(&output)) {
      if (notice->severity == Notice::Severity::kError) {
        refusal_ = notice->text;
        continue;
      }
      fmt::print(stderr, "{}: {:.3f}: {}\n", settings_.program,
                 static_cast<double>(notice->stamp.ns) * 1e-9, notice->text);
    }
  }
}

void Replay::Judge() {
  verdict_ = odometry_.Judge();
  lidar_check_.AddTo(verdict_);
}

void Replay::TellFailure() {
  if (!writer_.failure() || has_told_failure_) return;
  has_told_failure_ = true;
  fmt::print(stderr, "{}: {}; the files of this run are not complete\n", settings_.program,
             *writer_.failure());
}

void Replay::Finish(const LogInput& input, double wall_s) {
  if (settings_.writes_map) writer_.WriteMap(map_.points_map(), settings_.map_format);
  RunStats stats;
  stats.counters = odometry_.counters();
  stats.input = input.counters();
  stats.account.ledgers = odometry_.ledgers();
  stats.num_skipped_bytes = input.num_skipped_bytes();
  if (const std::string why = WhyOpen(stats.account, stats.input); !why.empty()) {
    fmt::print(stderr, "{}: {}; please report this\n", settings_.program, why);
  }
  stats.log_duration_s = input.duration_s();
  stats.wall_s = wall_s;
  stats.verdict = verdict_;
  stats.beams = worker_.FoundBeams();
  stats.num_passes = num_passes_;
  try {
    writer_.Finish(stats);
  } catch (const WriteError&) {
    TellFailure();
  }
}

std::string LogComplaint(const std::string& log, const LogInput& input, const Counters& counters,
                         const LogInputOptions& options) {
  if (counters.num_chunks == 0) {
    const bool is_whole = options.start_s == 0.0 && std::isinf(options.duration_s);
    return fmt::format(
        "{} has no scans on {}{}: nothing to estimate; see what it holds with 'lio-log info'", log,
        options.channels.scan, is_whole ? "" : " in the part that --start and --duration leave");
  }
  std::string text;
  if (input.num_skipped_bytes() > 0) {
    text = fmt::format("skipped {} damaged bytes", input.num_skipped_bytes());
  }
  if (const std::int64_t refused = input.counters().TotalRefused(); refused > 0) {
    text += fmt::format("{}refused {} undecodable messages", text.empty() ? "" : " and ", refused);
  }
  return text.empty() ? text : fmt::format("{}: {}; the rest was replayed", log, text);
}

}  // namespace lio
