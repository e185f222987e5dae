// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the UDP datagrams of a network capture (pcap or pcapng), of IPv4 over Ethernet, Linux's
// "cooked" link or raw IP. Datagrams that were sent in fragments are put together.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lio/base/time.hpp"
#include "lio/io/lcm_codec.hpp"

struct pcap;

namespace lio {

struct UdpDatagram {
  Timestamp received;        // arrival of its last fragment, by the clock of the capturing host
  std::uint32_t source = 0;  // address of the sender
  std::uint16_t port = 0;    // to which it was sent
  ByteView payload;          // valid until the next call of Next()
};

// "192.168.1.201"
[[nodiscard]] std::string AddressText(std::uint32_t address);

struct CaptureCounts {
  std::int64_t num_frames = 0;
  std::int64_t num_other = 0;           // no UDP over IPv4
  std::int64_t num_cut = 0;             // captured with fewer bytes than were sent, or malformed
  std::int64_t num_fragments_lost = 0;  // fragments of datagrams that never became whole
  std::string fault;                    // why the file ends early; empty when it does not

  [[nodiscard]] bool Any() const { return num_cut > 0 || num_fragments_lost > 0 || !fault.empty(); }
};

class UdpCapture {
 public:
  // Throws InputError that names the file when it is no capture, or of a link of another kind.
  explicit UdpCapture(const std::filesystem::path& path);

  // Returns false at the end, and where the file is damaged.
  [[nodiscard]] bool Next(UdpDatagram& datagram);
  [[nodiscard]] const CaptureCounts& counts() const { return counts_; }
  // Returns the share of the file that was read, 0..1.
  [[nodiscard]] double progress() const;

 private:
  struct Close {
    void operator()(pcap* capture) const;
  };
  struct Fragments {
    std::map<std::uint32_t, std::vector<std::uint8_t>> parts;  // by offset
    std::optional<std::uint32_t> size;                         // known once the last part is there
  };
  // Source, identification: what fragments of one datagram have in common.
  using FragmentKey = std::pair<std::uint32_t, std::uint16_t>;

  [[nodiscard]] std::optional<ByteView> IpPacket(ByteView frame) const;
  [[nodiscard]] bool TakeIp(ByteView packet, UdpDatagram& datagram);
  [[nodiscard]] bool TakeFragment(const FragmentKey& key, std::uint32_t offset, bool is_last,
                                  ByteView part);
  [[nodiscard]] bool TakeUdp(ByteView segment, UdpDatagram& datagram);

  std::unique_ptr<pcap, Close> capture_;
  std::int64_t size_bytes_ = 0;
  int link_ = 0;
  std::map<FragmentKey, Fragments> fragments_;
  std::vector<FragmentKey> fragment_order_;  // the oldest first
  std::vector<std::uint8_t> whole_;
  CaptureCounts counts_;
};

}  // namespace lio
