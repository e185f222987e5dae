// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Enlarges the kernel's receive buffer of liblcm's socket, which decides whether scans get through:
// a sweep is a burst of some twenty datagrams of 60 kB, and stock kernels hold three of them.
// liblcm does not hand its socket out, so it is found among those of this process by its port.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace lio {

inline constexpr int kWantedReceiveBytes = 8 << 20;
inline constexpr int kEnoughReceiveBytes = 2 << 20;  // less loses scans (docs/messages.md)

// Finds a UDP socket of this process that is bound to `port`; nothing when there is none.
[[nodiscard]] std::optional<int> FindUdpSocket(int port);

// Asks for a receive buffer of `wanted_bytes`, beyond the system's limit when this process may
// exceed it; a larger buffer stays as it is. Returns the size it has afterwards, counted as
// net.core.rmem_max does (getsockopt reports twice that), or 0 when `fd` is no socket.
[[nodiscard]] int RaiseReceiveBuffer(int fd, int wanted_bytes);

// Returns the number of datagrams that the kernel has dropped at this socket; nothing when it is
// unknown.
[[nodiscard]] std::optional<std::int64_t> KernelDrops(int fd);

// Returns the two commands with which an administrator allows buffers of kWantedReceiveBytes.
[[nodiscard]] std::string ReceiveBufferAdvice();

}  // namespace lio
