// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives the inertial samples and scan chunks of a log, decoded, in the log's order.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <variant>

#include "lio/io/event_log.hpp"
#include "lio/io/input_decoder.hpp"
#include "lio/pipeline/odometry.hpp"

namespace lio {

struct LogInputOptions {
  Channels channels;
  double start_s = 0.0;  // events received earlier than this after the first are left out
  double duration_s = std::numeric_limits<double>::infinity();
  ClockNs clock = nullptr;   // for decode_ns
  bool reads_ahead = false;  // on a further thread; the items are the same
};

struct InputItem {
  std::variant<ImuSample, ScanChunk> data;
  std::int64_t utime = 0;      // when the log received it
  std::int64_t decode_ns = 0;  // CPU time of decoding it
  std::int64_t position_bytes = 0;
};

class LogInput {
 public:
  // Throws std::runtime_error naming the file when it cannot be opened.
  LogInput(const std::filesystem::path& path, const LogInputOptions& options);
  ~LogInput();
  LogInput(const LogInput&) = delete;
  LogInput& operator=(const LogInput&) = delete;

  // Returns the next item, or nothing at the end. Throws what reading or decoding throws, e.g.
  // std::bad_alloc, also when a further thread reads ahead; the items before it come first.
  [[nodiscard]] std::optional<InputItem> Next();

  [[nodiscard]] std::int64_t size_bytes() const;
  // The counts are complete once Next has given nothing.
  [[nodiscard]] const InputCounters& counters() const;
  [[nodiscard]] std::int64_t num_skipped_bytes() const;
  [[nodiscard]] double duration_s() const;  // from the first event handed out to the last

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lio
