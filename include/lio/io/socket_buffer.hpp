// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The kernel's receive buffer of liblcm's socket decides whether scans get through: a sweep is some
// twenty datagrams of 60 kB in a burst, and stock kernels hold three. liblcm does not give its
// socket away, so it is found among this process's own by its port.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace lio {

inline constexpr int kWantedReceiveBytes = 8 << 20;
inline constexpr int kEnoughReceiveBytes = 2 << 20;  // less loses scans (docs/messages.md)

// A UDP socket of this process that is bound to `port`; nothing when there is none.
std::optional<int> FindUdpSocket(int port);

// Asks for a receive buffer of `wanted_bytes`, beyond the system's limit where this process may.
// Returns what it is now, as net.core.rmem_max counts it (getsockopt reports twice that); a larger
// buffer stays as it is. 0 when `fd` is no socket.
int RaiseReceiveBuffer(int fd, int wanted_bytes);

// How many datagrams the kernel has dropped at this socket; nothing when it does not tell.
std::optional<std::int64_t> KernelDrops(int fd);

// What an administrator types to allow buffers of kWantedReceiveBytes: two lines.
std::string ReceiveBufferAdvice();

}  // namespace lio
