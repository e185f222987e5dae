// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Bounds what waits inside a transport by its bytes, too, where the transport counts messages
// alone: the larger the messages are that come, the fewer of them may wait.
#pragma once

#include <algorithm>
#include <cstddef>

namespace lio {

class QueueCapacity {
 public:
  // Chosen: 1024 chunks of one datagram, some forty sweeps.
  static constexpr std::size_t kMaxBytes = 64 << 20;
  // Chosen: a message of the largest size must not shut out those that come with it.
  static constexpr int kLeast = 8;

  explicit QueueCapacity(int max_messages) : max_messages_(max_messages), now_(max_messages) {}

  // Takes the size of a message that came. Returns true when the capacity is another from now on.
  [[nodiscard]] bool Take(std::size_t bytes) {
    bytes_ = std::max(bytes, bytes_ - bytes_ / 8);  // a large one is forgotten after some dozens
    const std::size_t fitting = kMaxBytes / std::max<std::size_t>(bytes_, 1);
    const int now = std::clamp(static_cast<int>(std::min<std::size_t>(fitting, 1 << 20)),
                               std::min(kLeast, max_messages_), max_messages_);
    const bool is_other = now != now_;
    now_ = now;
    return is_other;
  }
  [[nodiscard]] int now() const { return now_; }  // messages

 private:
  int max_messages_;
  int now_;
  std::size_t bytes_ = 0;  // size of the largest message lately
};

}  // namespace lio
