// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads and writes LCM event logs as lcm-logger does: each event has a header (sync word
// 0xEDA1DA01, event number, utime, lengths; big-endian), a channel and a payload. The reader skips
// damage up to the next plausible event and counts the skipped bytes; liblcm's reader stops there
// or crashes (docs/messages.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lio/io/output_file.hpp"

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
  explicit EventLogWriter(const std::filesystem::path& path,
                          OutputFile::Links links = OutputFile::Links::kFollowed);
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
  [[nodiscard]] bool Next(LogEvent& event);

  // Bytes of damage skipped so far; an event that the end of the file cuts off counts as damage.
  [[nodiscard]] std::int64_t skipped_bytes() const;
  [[nodiscard]] std::int64_t position_bytes() const;  // for progress bars
  [[nodiscard]] std::int64_t size_bytes() const;
  // Next goes on from there: a position_bytes() from before an earlier Next.
  void SeekTo(std::int64_t position_bytes);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lio
