// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs the estimator over a log, without a clock and without dropping anything.
#pragma once

#include <optional>
#include <string>

#include "lio/io/lidar_check.hpp"
#include "lio/io/log_input.hpp"
#include "lio/io/map_cloud.hpp"
#include "lio/io/run_writer.hpp"
#include "lio/pipeline/found_sensors.hpp"
#include "lio/pipeline/initial_map.hpp"
#include "lio/pipeline/odometry.hpp"
#include "lio/pipeline/registration_worker.hpp"

namespace lio {

struct ReplaySettings {
  std::string program;  // is named at the progress bar and before each notice
  bool writes_map = false;
  MapFormat map_format = MapFormat::kPcd;
  InitialMapPtr initial_map;  // null: the first scans begin a map
  int match_lag = 0;  // messages by which each match's result is taken late; the files are the same
};

// Holds what a replay has found of the sensors, for another one of the same log.
struct FoundByReplay {
  FoundSensors sensors;
  std::optional<BeamCalibration> beams;  // absent: of no use, as in a tunnel
};

// Feeds the estimator and carries its outputs to the files. Notices go to stderr as well.
class Replay {
 public:
  // `found`: by a replay of the same log; null where this is the first.
  Replay(const Options& options, const ReplaySettings& settings, RunWriter& writer,
         const FoundByReplay* found = nullptr);

  // Replays all of `input`, or up to the notice that the options contradict it, and completes the
  // files. If one cannot be written, stderr tells at once; the estimate goes on without rows.
  void Run(LogInput& input);

  [[nodiscard]] const Counters& counters() const { return odometry_.counters(); }
  // Call it after Run only.
  [[nodiscard]] const Verdict& verdict() const { return verdict_; }
  [[nodiscard]] FoundByReplay found() const;
  // Says why the configuration contradicts the log; empty when it does not.
  [[nodiscard]] const std::string& refusal() const { return refusal_; }

 private:
  void Add(InputItem item);
  void Match();
  void AddToMap(const InsertTask& insert);
  [[nodiscard]] bool StartMatch();
  void TakeOutputs();
  void TellFailure();
  void Judge();
  void Finish(const LogInput& input, double wall_s);

  ReplaySettings settings_;
  RunWriter& writer_;
  Odometry odometry_;
  RegistrationWorker worker_;
  MapCloud map_;
  LidarCheck lidar_check_;
  std::optional<MatchOutcome> outcome_;  // from the last match, until it is taken
  int num_messages_to_wait_ = 0;         // messages to read before it is taken
  std::int64_t decode_ns_ = 0;
  bool has_told_failure_ = false;
  std::string refusal_;
  Verdict verdict_;
  int num_passes_ = 1;  // over this log, this one included
};

// Says in one line what was wrong with the log, e.g. that it has no scans; empty when nothing was.
[[nodiscard]] std::string LogComplaint(const std::string& log, const LogInput& input,
                                       const Counters& counters, const LogInputOptions& options);

}  // namespace lio
