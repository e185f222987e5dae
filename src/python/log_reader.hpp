// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives what a log holds in the log's order: inertial samples, whole sweeps, and liod's estimates.
#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "lio/base/counters.hpp"
#include "lio/io/event_log.hpp"
#include "lio/io/input_decoder.hpp"
#include "lio/sensor/imu_sample.hpp"
#include "lio/stream/scan_assembler.hpp"
#include "python/estimate.hpp"

namespace lio::python {

// Samples that came one after another, with no other item in between.
struct ImuBatch {
  std::vector<ImuSample> samples;
};

using LogItem = std::variant<ImuBatch, Sweep, Estimate>;

class LogReader {
 public:
  // Throws InputError for what is no log, and std::runtime_error when it cannot be opened.
  LogReader(const std::filesystem::path& log, const std::string& channel_prefix);

  // Returns the next item, or nothing at the end. A sweep comes when its last chunk is in; one with
  // lost chunks 50 ms after its end, or when the sweep after the next begins.
  [[nodiscard]] std::optional<LogItem> Next();

  [[nodiscard]] std::int64_t num_skipped_bytes() const { return reader_.skipped_bytes(); }
  // Messages that were refused, outputs included.
  [[nodiscard]] std::int64_t num_refused() const {
    return decoder_.counters().TotalRefused() + num_outputs_refused_;
  }
  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  void Add(const LogEvent& event);
  void AddImu(const LogEvent& event);
  void AddChunk(const LogEvent& event);
  void CloseSweepsAt(std::int64_t utime);
  void AddNav(const LogEvent& event);
  void AddState(const LogEvent& event);
  void GiveSamples();
  void GiveSweeps();
  void End();

  Channels channels_;
  EventLogReader reader_;
  InputDecoder decoder_;
  Counters counters_;
  ScanAssembler assembler_;
  LogEvent event_;
  struct {
    Timestamp end;
    std::int64_t utime = 0;  // when the log received it
  } last_chunk_;
  ImuBatch samples_;  // they wait for an item of another kind
  std::deque<LogItem> items_;
  std::int64_t num_outputs_refused_ = 0;
  bool is_at_end_ = false;
};

}  // namespace lio::python
