// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// LCM event logs, as lcm-logger writes them: header (sync word 0xEDA1DA01, event number, utime,
// lengths; big-endian), channel, payload. The reader goes past damage to the next plausible event
// and counts what it skipped; liblcm's own stops there or crashes (docs/messages.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lio {

struct LogEvent {
  std::int64_t number = 0;
  std::int64_t utime = 0;  // us since the epoch, when the message was received
  std::string channel;
  std::vector<std::uint8_t> data;
};

class EventLogWriter {
 public:
  // Overwrites an existing file. Throws std::runtime_error naming the file when it cannot.
  explicit EventLogWriter(const std::filesystem::path& path);
  ~EventLogWriter();
  EventLogWriter(const EventLogWriter&) = delete;
  EventLogWriter& operator=(const EventLogWriter&) = delete;

  // Numbers events from 0. Throws std::runtime_error when the disk is full.
  void Write(std::int64_t utime, std::string_view channel, std::span<const std::uint8_t> data);
  // Flushes; throws std::runtime_error when that fails. The destructor flushes too, silently.
  void Close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

class EventLogReader {
 public:
  // Throws std::runtime_error naming the file when it cannot be opened.
  explicit EventLogReader(const std::filesystem::path& path);
  ~EventLogReader();
  EventLogReader(const EventLogReader&) = delete;
  EventLogReader& operator=(const EventLogReader&) = delete;

  // Reads the next event into `event`, reusing its memory; false at the end. Never throws on
  // damage and never allocates more than the file could hold.
  bool Next(LogEvent& event);

  std::int64_t skipped_bytes() const;   // damage passed over so far, a cut end included
  std::int64_t position_bytes() const;  // for progress bars
  std::int64_t size_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lio
