// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes an event log in the order of event times although events arrive slightly out of order: a
// chunk is sent before the cloud that it was cut from is received. Only events younger than a fixed
// span are held back, so that memory does not grow with the recording.
#pragma once

#include <filesystem>
#include <map>
#include <string_view>

#include "lio/base/time.hpp"
#include "lio/io/event_log.hpp"
#include "lio/io/lcm_codec.hpp"

namespace lio {

inline constexpr std::string_view kImuChannel = "LIO_IMU";
inline constexpr std::string_view kScanChannel = "LIO_SCAN";

class OrderedLog {
 public:
  static constexpr Duration kHold{2'000'000'000};

  // Throws std::runtime_error that names the file when it cannot be written.
  explicit OrderedLog(const std::filesystem::path& path) : writer_(path) {}

  // Events of equal microseconds keep the order of these calls.
  void Add(Timestamp event, std::string_view channel, Bytes data);
  // Writes the events that are held back. Throws std::runtime_error when the disk is full.
  void Close();

  // Counts events that arrived more than kHold late; they are written with the time of the last one
  // written.
  std::int64_t num_late() const { return num_late_; }
  std::int64_t num_events() const { return num_events_; }

 private:
  struct Event {
    std::string_view channel;
    Bytes data;
  };

  void WriteUpTo(std::int64_t utime);

  EventLogWriter writer_;
  std::multimap<std::int64_t, Event>
      held_;                         // keyed by utime; equal ones stay in the order of insertion
  std::int64_t newest_ = INT64_MIN;  // largest utime added
  std::int64_t last_written_ = INT64_MIN;
  std::int64_t num_late_ = 0;
  std::int64_t num_events_ = 0;
};

}  // namespace lio
