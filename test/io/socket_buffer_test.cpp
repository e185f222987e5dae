// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/socket_buffer.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <vector>

namespace lio {
namespace {

// Opens a UDP socket on the loopback device, at a port that the kernel chooses.
class UdpSocket {
 public:
  UdpSocket() : fd_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::bind(fd_, Address(), sizeof(address_)), 0);
    socklen_t size = sizeof(address_);
    EXPECT_EQ(::getsockname(fd_, Address(), &size), 0);
  }
  ~UdpSocket() { ::close(fd_); }
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;

  int fd() const { return fd_; }
  int port() const { return ntohs(address_.sin_port); }
  sockaddr* Address() { return reinterpret_cast<sockaddr*>(&address_); }

 private:
  int fd_;
  sockaddr_in address_{};
};

TEST(SocketBuffer, TheSocketIsFoundByItsPort) {
  const UdpSocket other;
  const UdpSocket socket;
  EXPECT_EQ(FindUdpSocket(socket.port()), socket.fd());
  EXPECT_EQ(FindUdpSocket(other.port()), other.fd());
}

TEST(SocketBuffer, AClosedSocketIsNotFound) {
  int port = 0;
  {
    const UdpSocket socket;
    port = socket.port();
  }
  EXPECT_EQ(FindUdpSocket(port), std::nullopt);
}

TEST(SocketBuffer, RaisingGoesAsFarAsAllowedAndNeverDown) {
  const UdpSocket socket;
  constexpr int kSmall = 64 << 10;
  ASSERT_EQ(::setsockopt(socket.fd(), SOL_SOCKET, SO_RCVBUF, &kSmall, sizeof(kSmall)), 0);
  EXPECT_EQ(RaiseReceiveBuffer(socket.fd(), kSmall / 2), kSmall);
  EXPECT_GE(RaiseReceiveBuffer(socket.fd(), 2 * kSmall), 2 * kSmall);
}

TEST(SocketBuffer, DroppedDatagramsAreCountedExactly) {
  UdpSocket receiver;
  const UdpSocket sender;
  constexpr int kSmall = 16 << 10;
  ASSERT_EQ(::setsockopt(receiver.fd(), SOL_SOCKET, SO_RCVBUF, &kSmall, sizeof(kSmall)), 0);
  ASSERT_EQ(KernelDrops(receiver.fd()), 0);
  constexpr int kNumSent = 100;
  std::vector<char> datagram(4000);
  for (int i = 0; i < kNumSent; ++i) {
    ASSERT_EQ(::sendto(sender.fd(), datagram.data(), datagram.size(), 0, receiver.Address(),
                       sizeof(sockaddr_in)),
              std::ssize(datagram));
  }
  int num_received = 0;
  while (::recv(receiver.fd(), datagram.data(), datagram.size(), MSG_DONTWAIT) > 0) ++num_received;
  EXPECT_LT(num_received, kNumSent);
  EXPECT_EQ(KernelDrops(receiver.fd()), kNumSent - num_received);
}

TEST(SocketBuffer, WhatIsNoSocketHasNeitherBufferNorDrops) {
  EXPECT_EQ(RaiseReceiveBuffer(-1, 1), 0);
  EXPECT_EQ(KernelDrops(-1), std::nullopt);
}

TEST(SocketBuffer, AdviceIsTwoCommands) {
  EXPECT_EQ(ReceiveBufferAdvice(),
            "sudo sysctl -w net.core.rmem_max=8388608\n"
            "sudo sysctl -w net.core.rmem_default=2097152");
}

}  // namespace
}  // namespace lio
