// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tells systemd how the service is, where systemd has started it with Type=notify.
//
// The protocol is a datagram to the socket that NOTIFY_SOCKET names, as sd_notify(3) has it, which
// promises that it is stable. libsystemd would bring four libraries into the daemon for that.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace lio {

class ServiceNotifier {
 public:
  // Takes NOTIFY_SOCKET and WATCHDOG_USEC from the environment, and WATCHDOG_PID, which must be
  // this process where it is set.
  ServiceNotifier();

  // `state`: e.g. "READY=1". Does nothing where nobody listens. Any thread may call it.
  void Tell(const std::string& state) const;

  // The watchdog wants to hear from the service within this time; nothing without a watchdog.
  [[nodiscard]] std::optional<std::chrono::microseconds> watchdog() const { return watchdog_; }

 private:
  std::string socket_;
  std::optional<std::chrono::microseconds> watchdog_;
};

}  // namespace lio
