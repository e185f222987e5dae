// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Where messages come from and go to: LCM (any URL), memory (tests), or nowhere (benchmarks).
// Bytes only: what they mean is lcm_codec's business.
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

// No transport: the message says what to do. Programs end with exit code 4.
class TransportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class ReceiveResult {
  kMessage,  // one message was handed to its subscriber
  kTimeout,  // none came in time, or a signal interrupted the wait
  kClosed,   // none will come any more: a log is at its end, a connection broke
};

class Bus {
 public:
  // `data` is valid during the call only; `recv_utime` is the host's clock (us since the epoch)
  // when the message arrived, for measuring latency and nothing else.
  using Handler = std::function<void(ByteView data, std::int64_t recv_utime)>;

  virtual ~Bus() = default;

  // `channel` is a plain name, not an expression. At most `queue_capacity` messages wait inside the
  // transport; newer ones are lost there. What a handler throws is counted and goes no further.
  virtual void Subscribe(const std::string& channel, int queue_capacity, Handler handler) = 0;

  // Waits up to `timeout` for a message and hands it to its handlers.
  virtual ReceiveResult Receive(std::chrono::milliseconds timeout) = 0;

  // False when the transport refused the message.
  virtual bool Publish(const std::string& channel, ByteView data) = 0;

  // Messages above kMaxMessageBytes, and those whose handler threw; neither got any further.
  virtual std::int64_t num_oversized() const = 0;
  virtual std::int64_t num_handler_faults() const = 0;
};

// An LCM transport. Empty `url`: LCM_DEFAULT_URL of the environment, else LCM's own default. Throws
// TransportError when LCM cannot open it.
std::unique_ptr<Bus> OpenLcmBus(const std::string& url);

// Messages published on it come back to its own subscribers, in order.
std::unique_ptr<Bus> OpenMemoryBus();

// Takes everything, delivers nothing.
std::unique_ptr<Bus> OpenNullBus();

// The UDP port that OpenLcmBus(url) listens on; 0 when it is not udpm.
int UdpPort(const std::string& url);

}  // namespace lio
