// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "udp_capture.hpp"

#include <fmt/format.h>
#include <pcap/pcap.h>

#include <algorithm>

#include "lio/base/stamp_limit.hpp"
#include "lio/convert/byte_order.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"

namespace lio {
namespace {

constexpr std::uint16_t kIpv4 = 0x0800;
constexpr std::uint8_t kUdp = 17;
constexpr std::size_t kMaxDatagramBytes = 65'535;
constexpr std::size_t kMaxUnfinished = 64;  // datagrams in pieces at a time; older ones are lost

std::uint16_t Big16(ByteView bytes, std::size_t at) {
  return LoadAs<std::uint16_t>(bytes.data() + at, true);
}

// Returns how many bytes stand in front of an IPv4 packet; nothing when there is none.
std::optional<std::size_t> EthernetHeaderBytes(ByteView frame) {
  constexpr std::size_t kTagBytes = 4;
  std::size_t at = 12;
  while (frame.size() >= at + 2) {
    const std::uint16_t type = Big16(frame, at);
    if (type == kIpv4) return at + 2;
    if (type != 0x8100 && type != 0x88a8) return std::nullopt;
    at += kTagBytes;  // the tag of a VLAN
  }
  return std::nullopt;
}

std::optional<std::size_t> HeaderBytes(ByteView frame, int link) {
  constexpr std::size_t kCookedBytes = 16;
  constexpr std::size_t kCooked2Bytes = 20;
  switch (link) {
    case DLT_EN10MB:
      return EthernetHeaderBytes(frame);
    case DLT_RAW:
    case DLT_IPV4:
      return 0;
    case DLT_NULL:
      return 4;
    case DLT_LINUX_SLL:
      return frame.size() >= kCookedBytes && Big16(frame, 14) == kIpv4 ? std::optional(kCookedBytes)
                                                                       : std::nullopt;
    case DLT_LINUX_SLL2:
      return frame.size() >= kCooked2Bytes && Big16(frame, 0) == kIpv4
                 ? std::optional(kCooked2Bytes)
                 : std::nullopt;
    default:
      return std::nullopt;
  }
}

bool IsKnownLink(int link) {
  constexpr std::array kLinks = {DLT_EN10MB, DLT_RAW,       DLT_IPV4,
                                 DLT_NULL,   DLT_LINUX_SLL, DLT_LINUX_SLL2};
  return std::find(kLinks.begin(), kLinks.end(), link) != kLinks.end();
}

}  // namespace

std::string AddressText(std::uint32_t address) {
  return fmt::format("{}.{}.{}.{}", address >> 24, (address >> 16) & 255, (address >> 8) & 255,
                     address & 255);
}

void UdpCapture::Close::operator()(pcap* capture) const {
  pcap_close(capture);
}

UdpCapture::UdpCapture(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) throw InputError(path.string() + ": no such file");
  RefuseIrregular(path);
  std::array<char, PCAP_ERRBUF_SIZE> reason{};
  capture_.reset(pcap_open_offline_with_tstamp_precision(path.c_str(), PCAP_TSTAMP_PRECISION_NANO,
                                                         reason.data()));
  if (!capture_) throw InputError(path.string() + ": no network capture: " + reason.data());
  size_bytes_ = static_cast<std::int64_t>(std::filesystem::file_size(path));
  link_ = pcap_datalink(capture_.get());
  if (IsKnownLink(link_)) return;
  const char* name = pcap_datalink_val_to_name(link_);
  throw InputError(fmt::format("{}: captured on a link of kind {}; needed is Ethernet or IP",
                               path.string(), name ? name : std::to_string(link_)));
}

double UdpCapture::progress() const {
  std::FILE* file = pcap_file(capture_.get());
  const long at = file ? std::ftell(file) : 0;
  return std::clamp(static_cast<double>(at) / static_cast<double>(size_bytes_), 0.0, 1.0);
}

bool UdpCapture::Next(UdpDatagram& datagram) {
  pcap_pkthdr* header = nullptr;
  const u_char* data = nullptr;
  int status = 0;
  while ((status = pcap_next_ex(capture_.get(), &header, &data)) == 1) {
    ++counts_.num_frames;
    constexpr std::int64_t kNsPerSecond = 1'000'000'000;
    const std::int64_t seconds =
        std::clamp<std::int64_t>(header->ts.tv_sec, 0, kMaxStamp_ns / kNsPerSecond);
    datagram.received =
        Timestamp{seconds * kNsPerSecond + header->ts.tv_usec};  // in ns, as was asked for
    const auto packet = IpPacket(ByteView(data, header->caplen));
    if (!packet) {
      ++counts_.num_other;
    } else if (header->caplen < header->len) {
      ++counts_.num_cut;
    } else if (TakeIp(*packet, datagram)) {
      return true;
    }
  }
  if (status == PCAP_ERROR) counts_.fault = pcap_geterr(capture_.get());
  for (const auto& [key, datagram_parts] : fragments_) {
    counts_.num_fragments_lost += static_cast<std::int64_t>(datagram_parts.parts.size());
  }
  fragments_.clear();
  return false;
}

std::optional<ByteView> UdpCapture::IpPacket(ByteView frame) const {
  constexpr std::size_t kIpHeaderBytes = 20;
  const auto before = HeaderBytes(frame, link_);
  if (!before || frame.size() < *before + kIpHeaderBytes) return std::nullopt;
  const ByteView packet = frame.subspan(*before);
  const bool is_udp = packet[0] >> 4 == 4 && packet[9] == kUdp;
  return is_udp ? std::optional(packet) : std::nullopt;
}

bool UdpCapture::TakeIp(ByteView packet, UdpDatagram& datagram) {
  const std::size_t header_bytes = std::size_t{4} * (packet[0] & 15);
  const std::size_t size = Big16(packet, 2);
  if (header_bytes < 20 || size < header_bytes || size > packet.size()) {
    ++counts_.num_cut;
    return false;
  }
  datagram.source = LoadAs<std::uint32_t>(packet.data() + 12, true);
  const std::uint16_t flags = Big16(packet, 6);
  const std::uint32_t offset = std::uint32_t{8} * (flags & 0x1fff);
  const bool is_last = (flags & 0x2000) == 0;
  const ByteView part = packet.subspan(header_bytes, size - header_bytes);
  if (offset == 0 && is_last) return TakeUdp(part, datagram);
  return TakeFragment({datagram.source, Big16(packet, 4)}, offset, is_last, part) &&
         TakeUdp(whole_, datagram);
}

// Returns whether the datagram is whole now.
bool UdpCapture::TakeFragment(const FragmentKey& key, std::uint32_t offset, bool is_last,
                              ByteView part) {
  if (offset + part.size() > kMaxDatagramBytes) {
    ++counts_.num_cut;
    return false;
  }
  if (!fragments_.contains(key)) {
    if (fragment_order_.size() == kMaxUnfinished) {
      counts_.num_fragments_lost +=
          static_cast<std::int64_t>(fragments_[fragment_order_.front()].parts.size());
      fragments_.erase(fragment_order_.front());
      fragment_order_.erase(fragment_order_.begin());
    }
    fragment_order_.push_back(key);
  }
  Fragments& fragments = fragments_[key];
  fragments.parts[offset].assign(part.begin(), part.end());
  if (is_last) fragments.size = offset + static_cast<std::uint32_t>(part.size());
  whole_.clear();
  for (const auto& [begin, bytes] : fragments.parts) {
    if (begin != whole_.size()) return false;
    whole_.insert(whole_.end(), bytes.begin(), bytes.end());
  }
  if (!fragments.size || whole_.size() != *fragments.size) return false;
  fragments_.erase(key);
  std::erase(fragment_order_, key);
  return true;
}

bool UdpCapture::TakeUdp(ByteView segment, UdpDatagram& datagram) {
  constexpr std::size_t kUdpHeaderBytes = 8;
  const std::size_t size = segment.size() < kUdpHeaderBytes ? 0 : Big16(segment, 4);
  if (size < kUdpHeaderBytes || size > segment.size()) {
    ++counts_.num_cut;
    return false;
  }
  datagram.port = Big16(segment, 2);
  datagram.payload = segment.subspan(kUdpHeaderBytes, size - kUdpHeaderBytes);
  return true;
}

}  // namespace lio
