// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "app/service_notifier.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace lio {
namespace {

std::string Environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

std::int64_t Number(const std::string& text) {
  std::int64_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

}  // namespace

ServiceNotifier::ServiceNotifier() : socket_(Environment("NOTIFY_SOCKET")) {
  const std::string pid = Environment("WATCHDOG_PID");
  const std::int64_t watchdog_us = Number(Environment("WATCHDOG_USEC"));
  if (watchdog_us > 0 && (pid.empty() || Number(pid) == ::getpid())) {
    watchdog_ = std::chrono::microseconds(watchdog_us);
  }
}

void ServiceNotifier::Tell(const std::string& state) const {
  sockaddr_un address{};
  const bool is_path = !socket_.empty() && (socket_[0] == '/' || socket_[0] == '@');
  if (!is_path || socket_.size() >= sizeof(address.sun_path)) return;
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, socket_.data(), socket_.size());
  if (socket_[0] == '@') address.sun_path[0] = '\0';  // a name of the abstract kind
  const int fd = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return;
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + socket_.size());
  // The sockets API takes every address family through one pointer type.
  (void)::sendto(fd, state.data(), state.size(), MSG_NOSIGNAL | MSG_DONTWAIT,
                 reinterpret_cast<const sockaddr*>(&address), size);
  ::close(fd);
}

}  // namespace lio
