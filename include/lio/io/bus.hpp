// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A bus carries messages as bytes: over LCM (any URL), in memory (for tests), or to nowhere (for
// benchmarks). lcm_codec.hpp encodes and decodes them.
//
// One thread receives; any thread may publish. Subscribe before the first Receive, and never after
// it: liblcm 1.3.1 corrupts memory when subscriptions change while it delivers.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "lio/io/lcm_codec.hpp"

namespace lio {

// The transport cannot be used. The message says what to do; programs end with exit code 4.
class TransportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class ReceiveResult {
  kMessage,  // one message was handed to its subscriber
  kTimeout,  // no message came in time, or a signal interrupted the wait
  kClosed,   // no message will come any more: a log is at its end, a connection broke
};

class Bus {
 public:
  // `data` is valid during the call only; `recv_utime` is the host's clock (us since the epoch)
  // when the message arrived, for measuring latency and nothing else.
  using Handler = std::function<void(ByteView data, std::int64_t recv_utime)>;

  virtual ~Bus() = default;

  // `channel` is a plain name, not an expression. At most `queue_capacity` messages wait inside the
  // transport, fewer where they are large (queue_capacity.hpp); newer ones are lost there. An
  // exception of a handler is counted and goes no further.
  virtual void Subscribe(const std::string& channel, int queue_capacity, Handler handler) = 0;

  // Waits up to `timeout` for a message and hands it to its handlers.
  [[nodiscard]] virtual ReceiveResult Receive(std::chrono::milliseconds timeout) = 0;

  // Returns false when the transport refused the message.
  [[nodiscard]] virtual bool Publish(const std::string& channel, ByteView data) = 0;

  // How many messages were above kMaxMessageBytes, and for how many a handler threw. Neither got
  // any further.
  [[nodiscard]] virtual std::int64_t num_oversized() const = 0;
  [[nodiscard]] virtual std::int64_t num_handler_faults() const = 0;
};

// Says what an LCM URL stands for: an empty one for LCM_DEFAULT_URL of the environment, or else for
// LCM's own default.
[[nodiscard]] std::string EffectiveUrl(const std::string& url);

// Opens an LCM transport at EffectiveUrl(url). Throws TransportError when LCM cannot open it.
[[nodiscard]] std::unique_ptr<Bus> OpenLcmBus(const std::string& url);

// Returns a bus whose messages come back to its own subscribers, in order.
[[nodiscard]] std::unique_ptr<Bus> OpenMemoryBus();

// Returns a bus that takes every message and delivers none.
[[nodiscard]] std::unique_ptr<Bus> OpenNullBus();

// Returns the UDP port that OpenLcmBus(url) listens on; 0 when the URL is not udpm://.
[[nodiscard]] int UdpPort(const std::string& url);

}  // namespace lio
