// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes network captures (pcap, times in us) of UDP datagrams, in fragments where they are longer
// than a frame.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "lio/base/time.hpp"
#include "lio/io/lcm_codec.hpp"

namespace lio::test {

inline constexpr std::uint32_t kSensorAddress = 0xc0a801c9;  // 192.168.1.201

inline ByteView ViewOf(const std::string& bytes) {
  return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

class PacketBytes {
 public:
  template <typename T>
  PacketBytes& Little(T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i)
      bytes.push_back(static_cast<char>(value >> (8 * i)));
    return *this;
  }
  template <typename T>
  PacketBytes& Big(T value) {
    for (std::size_t i = sizeof(T); i-- > 0;) bytes.push_back(static_cast<char>(value >> (8 * i)));
    return *this;
  }
  PacketBytes& Put(const std::string& text) {
    bytes += text;
    return *this;
  }

  std::string bytes;
};

class CaptureWriter {
 public:
  // `link` is 1 for Ethernet.
  explicit CaptureWriter(std::uint32_t link = 1) {
    file_.Little(0xa1b2c3d4u).Little(std::uint16_t{2}).Little(std::uint16_t{4});
    file_.Little(0u).Little(0u).Little(262'144u).Little(link);
  }

  void Udp(Timestamp received, const std::string& payload, std::uint16_t port,
           std::uint32_t source = kSensorAddress) {
    PacketBytes segment;
    segment.Big(std::uint16_t{5000}).Big(port);
    segment.Big(static_cast<std::uint16_t>(payload.size() + 8)).Big(std::uint16_t{0}).Put(payload);
    constexpr std::size_t kMtu = 1480;
    const std::string& all = segment.bytes;
    for (std::size_t at = 0; at < all.size(); at += kMtu) {
      const bool is_last = at + kMtu >= all.size();
      Ip(received, all.substr(at, kMtu), source,
         static_cast<std::uint16_t>((is_last ? 0 : 0x2000) | (at / 8)));
    }
    ++identification_;
  }
  // A frame as it is, of which only `captured` bytes were kept.
  void Frame(Timestamp received, const std::string& frame, std::size_t captured = SIZE_MAX) {
    const std::string kept = frame.substr(0, captured);
    const std::int64_t us = received.ns / 1000;
    file_.Little(static_cast<std::uint32_t>(us / 1'000'000));
    file_.Little(static_cast<std::uint32_t>(us % 1'000'000));
    file_.Little(static_cast<std::uint32_t>(kept.size()));
    file_.Little(static_cast<std::uint32_t>(frame.size())).Put(kept);
  }
  [[nodiscard]] const std::string& bytes() const { return file_.bytes; }

 private:
  void Ip(Timestamp received, const std::string& part, std::uint32_t source, std::uint16_t flags) {
    PacketBytes frame;
    frame.Put(std::string(12, '\x02')).Big(std::uint16_t{0x0800});
    frame.Big(std::uint16_t{0x4500}).Big(static_cast<std::uint16_t>(20 + part.size()));
    frame.Big(identification_).Big(flags).Big(std::uint16_t{0x4011}).Big(std::uint16_t{0});
    frame.Big(source).Big(0xffffffffu).Put(part);
    Frame(received, frame.bytes);
  }

  PacketBytes file_;
  std::uint16_t identification_ = 7;
};

}  // namespace lio::test
