// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/socket_buffer.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <charconv>
#include <cstring>
#include <filesystem>

namespace lio {
namespace {

// SO_MEMINFO fills an array as linux/sock_diag.h describes it: the ninth word counts drops.
constexpr int kMemInfoDrops = 8;
constexpr int kMemInfoWords = 9;

bool IsUdpSocketAt(int fd, int port) {
  int type = 0;
  socklen_t size = sizeof(type);
  if (::getsockopt(fd, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_DGRAM) return false;
  sockaddr_storage storage{};
  size = sizeof(storage);
  // The sockets API takes every address family through one pointer type.
  if (::getsockname(fd, reinterpret_cast<sockaddr*>(&storage), &size) != 0) return false;
  if (storage.ss_family != AF_INET) return false;
  sockaddr_in address{};
  std::memcpy(&address, &storage, sizeof(address));
  return ntohs(address.sin_port) == port;
}

int ReceiveBytes(int fd) {
  int bytes = 0;
  socklen_t size = sizeof(bytes);
  return ::getsockopt(fd, SOL_SOCKET, SO_RCVBUF, &bytes, &size) == 0 ? bytes / 2 : 0;
}

}  // namespace

std::optional<int> FindUdpSocket(int port) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    const std::string name = entry.path().filename().string();
    int fd = -1;
    std::from_chars(name.data(), name.data() + name.size(), fd);
    if (fd >= 0 && IsUdpSocketAt(fd, port)) return fd;
  }
  return std::nullopt;
}

int RaiseReceiveBuffer(int fd, int wanted_bytes) {
  if (ReceiveBytes(fd) < wanted_bytes) {
    // The first call may lack the privilege; the second one then goes up to the system's limit.
    if (::setsockopt(fd, SOL_SOCKET, SO_RCVBUFFORCE, &wanted_bytes, sizeof(wanted_bytes)) != 0) {
      ::setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &wanted_bytes, sizeof(wanted_bytes));
    }
  }
  return ReceiveBytes(fd);
}

std::optional<std::int64_t> KernelDrops(int fd) {
  std::uint32_t words[kMemInfoWords] = {};
  socklen_t size = sizeof(words);
  if (::getsockopt(fd, SOL_SOCKET, SO_MEMINFO, words, &size) != 0 || size < sizeof(words)) {
    return std::nullopt;
  }
  return words[kMemInfoDrops];
}

std::string ReceiveBufferAdvice() {
  const std::string wanted = std::to_string(kWantedReceiveBytes);
  const std::string enough = std::to_string(kEnoughReceiveBytes);
  return "sudo sysctl -w net.core.rmem_max=" + wanted +
         "\nsudo sysctl -w net.core.rmem_default=" + enough;
}

}  // namespace lio
