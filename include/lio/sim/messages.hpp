// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Carries messages from the simulated sensors to the log.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/scan_chunk.hpp"

namespace lio::sim {

struct ImuMessage {
  ImuSample sample;
  std::int32_t seq = 0;
};

struct Message {
  Timestamp arrival;  // time at which it would be received; the log is in this order
  std::variant<ImuMessage, ScanChunk> body;
};

// Puts messages of bounded disorder into the order of arrival; messages of equal arrival keep the
// order in which they came.
class ArrivalQueue {
 public:
  void Push(Message message) {
    const Timestamp arrival = message.arrival;
    waiting_.emplace(arrival, std::move(message));
  }
  // Returns the next message that arrives before `limit`.
  [[nodiscard]] std::optional<Message> PopBefore(Timestamp limit) {
    if (waiting_.empty() || waiting_.begin()->first >= limit) return std::nullopt;
    return std::move(waiting_.extract(waiting_.begin()).mapped());
  }

 private:
  std::multimap<Timestamp, Message> waiting_;
};

}  // namespace lio::sim
