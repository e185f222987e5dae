// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Queues in front of the filter thread: decoded messages in the order of their arrival, and the
// outcome of the match that is under way.
//
// The queue is bounded. When more than kMaxPoints wait, all chunks of the oldest scan are dropped;
// when kMaxImu samples wait, the newest is refused. Both are counted. An outcome is taken before
// the messages: there is never more than one, and scans wait for it. Requests keep their place
// among the messages, so that what they change depends on the messages before them alone.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <variant>

#include "lio/io/command.hpp"
#include "lio/pipeline/registration_worker.hpp"

namespace lio {

template <typename Data>
struct Arrival {
  Data data;
  std::int64_t recv_utime = 0;  // host's clock, us since the epoch: for latency only
  std::int64_t decode_ns = 0;
};

// Holds a command, from the bus or by a signal of the system.
struct Request {
  Command command;
  bool is_answered = true;  // by a reply on the bus
};

// Asks whether the filter thread is alive.
struct Ping {};

using InboxItem = std::variant<Arrival<ImuSample>, Arrival<ScanChunk>, Request, MatchOutcome, Ping>;

class FilterInbox {
 public:
  static constexpr std::size_t kMaxImu = 1 << 16;           // a minute at 1 kHz
  static constexpr std::size_t kMaxPoints = 4 * (1 << 20);  // 80 MB, some seconds of any lidar

  static constexpr std::size_t kMaxRequests = 64;

  struct Losses {
    std::int64_t num_imu = 0;
    std::int64_t num_chunks = 0;
  };

  explicit FilterInbox(std::size_t max_imu = kMaxImu, std::size_t max_points = kMaxPoints)
      : max_imu_(max_imu), max_points_(max_points) {}

  void Put(Arrival<ImuSample> sample);
  void Put(Arrival<ScanChunk> chunk);
  void Put(MatchOutcome outcome);
  // Returns false when kMaxRequests wait already, or when nobody would take it any more.
  [[nodiscard]] bool Put(Request request);
  // It is taken before all that waits, so that the answer does not depend on how much that is.
  void Put(Ping ping);
  // No message will come any more; outcomes may.
  void Close();
  // No outcome will come any more, because the match thread has failed; messages may.
  void EndOutcomes();

  // Waits for the next item; null once closed and empty.
  [[nodiscard]] std::unique_ptr<InboxItem> Take();
  // Waits for the outcome and leaves messages where they are; nothing when none will come.
  [[nodiscard]] std::optional<MatchOutcome> TakeOutcome();

  [[nodiscard]] Losses losses() const;
  [[nodiscard]] Losses waiting() const;  // messages in the inbox

 private:
  void DropOldestScan();

  const std::size_t max_imu_;
  const std::size_t max_points_;
  mutable std::mutex mutex_;  // guards everything below
  std::condition_variable filled_;
  std::deque<std::unique_ptr<InboxItem>> messages_;  // no outcomes among them
  std::optional<MatchOutcome> outcome_;
  std::size_t num_imu_ = 0;
  std::size_t num_requests_ = 0;
  std::size_t num_points_ = 0;
  bool is_pinged_ = false;
  bool is_closed_ = false;
  bool are_outcomes_over_ = false;
  Losses losses_;
};

}  // namespace lio
