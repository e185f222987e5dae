// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Sends to LCM's multicast group what a broken or hostile sender might send: datagrams that are no
// LCM, LCM messages that are not of liod's types, and messages of its types with absurd contents.
// It sends no fragments with wrapping offsets, because they end any process that links liblcm
// (docs/messages.md).
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <thread>

#include "lio/io/status_report.hpp"

namespace lio {
namespace {

class Attacker {
 public:
  Attacker() : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    group_.sin_family = AF_INET;
    group_.sin_port = htons(7667);
    group_.sin_addr.s_addr = ::inet_addr("239.255.76.67");
  }
  ~Attacker() { ::close(socket_); }
  Attacker(const Attacker&) = delete;
  Attacker& operator=(const Attacker&) = delete;

  void SendRaw(const Bytes& datagram) {
    ::sendto(socket_, datagram.data(), datagram.size(), 0, reinterpret_cast<sockaddr*>(&group_),
             sizeof(group_));
    if (++num_sent_ % 20 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  // Sends an LCM short message: magic, sequence number, channel with its end, payload.
  void Send(const std::string& channel, const Bytes& payload, bool is_terminated = true) {
    Bytes datagram = {'L', 'C', '0', '2', 0, 0, 0, static_cast<std::uint8_t>(num_sent_)};
    datagram.insert(datagram.end(), channel.begin(), channel.end());
    if (is_terminated) datagram.push_back(0);
    datagram.insert(datagram.end(), payload.begin(), payload.end());
    SendRaw(datagram);
  }

  Bytes Random(std::size_t size) {
    Bytes bytes(size);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random_());
    return bytes;
  }
  std::size_t Below(std::size_t bound) { return random_() % bound; }

 private:
  int socket_;
  sockaddr_in group_{};
  unsigned num_sent_ = 0;
  std::mt19937 random_{99};
};

void SendGarbage(Attacker& attacker) {
  for (int i = 0; i < 200; ++i) attacker.SendRaw(attacker.Random(attacker.Below(2000)));
  for (const char* channel : {"LIO_IMU", "LIO_SCAN", "LIO_CMD"}) {
    for (int i = 0; i < 200; ++i) attacker.Send(channel, attacker.Random(attacker.Below(300)));
    attacker.Send(channel, {}, false);
    attacker.Send(channel, {});
  }
  for (int i = 0; i < 20; ++i) attacker.Send("LIO_IMU", EncodeChunk({}));
  for (int i = 0; i < 20; ++i) attacker.Send("LIO_SCAN", EncodeImu({}, i));
}

// Sends messages whose every byte is formally right.
void SendNonsense(Attacker& attacker) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr float kNanF = std::numeric_limits<float>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const Timestamp now{1'700'000'003'000'000'000};
  for (int i = 0; i < 100; ++i) {
    attacker.Send("LIO_IMU", EncodeImu({now, Vector3(kNan, 0, 0), Vector3(0, 0, 9.8)}, i));
    attacker.Send("LIO_IMU", EncodeImu({now, Vector3(0, 0, 0), Vector3(kInf, -kInf, 1e308)}, i));
  }
  for (const std::int16_t count : {std::int16_t{-1}, std::int16_t{0}, std::int16_t{32767}}) {
    for (const std::int16_t index : {std::int16_t{-1}, std::int16_t{0}, std::int16_t{32767}}) {
      ScanChunk chunk{now, 1'000'000, index, count, 0, {}};
      chunk.points.assign(10, {kNanF, kNanF, kNanF, 0xffffffff, 0xffff, 0xffff});
      attacker.Send("LIO_SCAN", EncodeChunk(chunk));
      chunk.points.clear();
      attacker.Send("LIO_SCAN", EncodeChunk(chunk));
    }
  }
  Bytes huge = EncodeChunk({now, 5, 0, 1, 0, std::vector<LidarPoint>(3)});
  for (const std::uint8_t top : {std::uint8_t{0x7f}, std::uint8_t{0xff}, std::uint8_t{0x20}}) {
    huge[36] = top;  // n_points
    huge[40] = top;  // n_bytes
    attacker.Send("LIO_SCAN", huge);
  }
}

}  // namespace
}  // namespace lio

int main() {
  lio::Attacker attacker;
  lio::SendGarbage(attacker);
  lio::SendNonsense(attacker);
  return 0;
}
