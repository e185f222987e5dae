// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "velodyne_decoder.hpp"

#include <cmath>

#include "lio/base/angle.hpp"
#include "lio/convert/byte_order.hpp"

namespace lio {
namespace {

constexpr std::size_t kPacketBytes = 1206;
constexpr std::size_t kBlockBytes = 100;
constexpr std::size_t kBlockHeaderBytes = 4;  // flag and azimuth
constexpr std::size_t kReturnBytes = 3;       // range and reflectivity
constexpr int kReturnsPerBlock = 32;
constexpr std::size_t kTimeAt = 1200, kModeAt = 1204, kProductAt = 1205;
constexpr std::uint16_t kBlockFlag = 0xeeff;
constexpr std::uint8_t kStrongest = 0x37, kLast = 0x38, kDual = 0x39;
constexpr double kRangeStep_m = 0.002;
constexpr int kAzimuthStepsPerTurn = 36'000;
constexpr std::int64_t kNsPerMicrosecond = 1'000;
constexpr std::int64_t kNsPerHour = 3'600'000'000'000;
constexpr std::uint32_t kMicrosecondsPerHour = 3'600'000'000;
constexpr double kMaxRate_radps = kTurn_rad * 35.0;  // the sensors turn at most 20 times a second
constexpr double kLongestTurn_s = 0.4;               // a head that stands does not fill the memory

std::uint16_t At16(ByteView payload, std::size_t at) {
  return LoadAs<std::uint16_t>(payload.data() + at, false);
}

std::size_t BlockAt(int block) {
  return kBlockBytes * static_cast<std::size_t>(block);
}

double Forward(double from_rad, double to_rad) {
  const double step = to_rad - from_rad;
  return step < 0.0 ? step + kTurn_rad : step;
}

std::int64_t Nanoseconds(double seconds) {
  return std::llround(1e9 * seconds);
}

}  // namespace

std::optional<std::string> VelodyneModel(ByteView payload) {
  constexpr int kHdl32e = 0x21, kVlp16 = 0x22;
  if (payload.size() != kPacketBytes) return std::nullopt;
  for (std::size_t at = 0; at < kTimeAt; at += kBlockBytes) {
    if (At16(payload, at) != kBlockFlag) return std::nullopt;
  }
  const int product = VelodyneProduct(payload);
  return product == kVlp16 ? "vlp16" : product == kHdl32e ? "hdl32e" : "";
}

int VelodyneProduct(ByteView payload) {
  return payload[kProductAt];
}

std::uint32_t VelodyneTime(ByteView payload) {
  return LoadAs<std::uint32_t>(payload.data() + kTimeAt, false);
}

Timestamp HourClock::At(std::uint32_t since_hour_us, Timestamp received) const {
  const std::int64_t near = received.ns - offset.ns;
  const std::int64_t in_hour = std::int64_t{since_hour_us} * kNsPerMicrosecond;
  const std::int64_t hours =
      std::llround(static_cast<double>(near - in_hour) / static_cast<double>(kNsPerHour));
  return Timestamp{hours * kNsPerHour + in_hour + offset.ns};
}

VelodyneDecoder::VelodyneDecoder(const std::string& model, HourClock clock)
    : table_(LoadFiringTable(model)), clock_(clock) {
  const auto rounds = kReturnsPerBlock / static_cast<int>(table_.channels.size());
  block_s_ = rounds * table_.period_s;
}

std::optional<VelodyneDecoder::Packet> VelodyneDecoder::Read(ByteView payload,
                                                             Timestamp received) const {
  Packet packet;
  packet.payload = payload;
  packet.received = received;
  const std::uint8_t mode = payload[kModeAt];
  if (mode != kStrongest && mode != kLast && mode != kDual) return std::nullopt;
  if (VelodyneTime(payload) >= kMicrosecondsPerHour) return std::nullopt;
  packet.blocks_per_firing = mode == kDual ? 2 : 1;
  packet.stamp = clock_.At(VelodyneTime(payload), received);
  for (int block = 0; block < kNumBlocks; ++block) {
    const int steps = At16(payload, BlockAt(block) + 2);
    if (steps >= kAzimuthStepsPerTurn) return std::nullopt;
    packet.azimuth_rad[static_cast<std::size_t>(block)] = kTurn_rad * steps / kAzimuthStepsPerTurn;
  }
  return packet;
}

void VelodyneDecoder::Add(ByteView payload, Timestamp received) {
  if (payload.size() != kPacketBytes) return;
  const auto packet = Read(payload, received);
  if (!packet) {
    ++counts_.num_damaged;
    return;
  }
  ++counts_.num_taken;
  NoteGap(*packet);
  rate_radps_ = RateOf(*packet);
  for (int block = 0; block < kNumBlocks; block += packet->blocks_per_firing) {
    BeginBlock(packet->azimuth_rad[static_cast<std::size_t>(block)], *packet);
    AddBlock(*packet, block);
  }
}

// A gap of more than a turn ends the turn; a shorter one is a hole in it.
void VelodyneDecoder::NoteGap(const Packet& packet) {
  const double packet_s = block_s_ * kNumBlocks / packet.blocks_per_firing;
  if (next_stamp_) {
    const double gap_s = SecondsBetween(*next_stamp_, packet.stamp);
    constexpr double kLongestGap_s = 3600.0;
    if (gap_s > 0.5 * packet_s && gap_s < kLongestGap_s) {
      counts_.num_lost += std::llround(gap_s / packet_s);
    }
    if (std::abs(gap_s) * rate_radps_ > kTurn_rad || gap_s < -packet_s) {
      Cut(packet.received);
      last_azimuth_rad_.reset();
    }
  }
  next_stamp_ = packet.stamp + Duration::FromSeconds(packet_s);
}

// The head's rate over the packet, which lasts a millisecond: it is steadier than the steps of
// 0.01 deg between two blocks. An impossible one leaves that of the packet before.
double VelodyneDecoder::RateOf(const Packet& packet) const {
  double turned_rad = 0.0;
  const int step = packet.blocks_per_firing;
  for (int block = step; block < kNumBlocks; block += step) {
    turned_rad += Forward(packet.azimuth_rad[static_cast<std::size_t>(block - step)],
                          packet.azimuth_rad[static_cast<std::size_t>(block)]);
  }
  const int num_firings = kNumBlocks / step;
  const double rate = turned_rad / (block_s_ * (num_firings - 1));
  return rate < kMaxRate_radps ? rate : rate_radps_;
}

void VelodyneDecoder::BeginBlock(double azimuth_rad, const Packet& packet) {
  const double before_rad = last_azimuth_rad_.value_or(azimuth_rad);
  const bool passes_zero = before_rad - azimuth_rad > 0.5 * kTurn_rad;
  const double step_rad = Forward(before_rad, azimuth_rad);
  if (step_rad < 0.5 * kTurn_rad) turned_rad_ += step_rad;
  last_azimuth_rad_ = azimuth_rad;
  const double span_s =
      turn_.instants_ns.empty()
          ? 0.0
          : 1e-9 * static_cast<double>(packet.stamp.ns - turn_.instants_ns.front());
  if (passes_zero || span_s > kLongestTurn_s) Cut(packet.received);
}

void VelodyneDecoder::Cut(Timestamp received) {
  turn_.is_whole = turned_rad_ > kWholeTurn * kTurn_rad;
  turn_.received = received;
  turned_rad_ = 0.0;
  const std::size_t usual = turn_.points.size();
  if (usual > 0) turns_.push_back(std::move(turn_));
  turn_ = Turn();
  turn_.points.reserve(usual + usual / 8);
  turn_.instants_ns.reserve(usual + usual / 8);
}

void VelodyneDecoder::AddBlock(const Packet& packet, int block) {
  const auto num_channels = static_cast<int>(table_.channels.size());
  const double azimuth_rad = packet.azimuth_rad[static_cast<std::size_t>(block)];
  const double begin_s = block_s_ * block / packet.blocks_per_firing;
  for (int index = 0; index < kReturnsPerBlock; ++index) {
    const auto& channel = table_.channels[static_cast<std::size_t>(index % num_channels)];
    const int round = index / num_channels;
    const double since_block_s = round * table_.period_s + channel.fire_time_s;
    AddReturns(packet, block, index, azimuth_rad + rate_radps_ * since_block_s,
               packet.stamp.ns + Nanoseconds(begin_s + since_block_s));
  }
}

// In dual mode the second block has the other return, or the same one again when there is no other.
void VelodyneDecoder::AddReturns(const Packet& packet, int block, int index, double azimuth_rad,
                                 std::int64_t instant_ns) {
  const auto& channel = table_.channels[static_cast<std::size_t>(index) % table_.channels.size()];
  const double heading_rad = channel.azimuth_offset_rad - azimuth_rad;
  int range_before = 0;
  for (int k = 0; k < packet.blocks_per_firing; ++k) {
    const std::size_t at =
        BlockAt(block + k) + kBlockHeaderBytes + kReturnBytes * static_cast<std::size_t>(index);
    const int steps = At16(packet.payload, at);
    if (steps == 0 || steps == range_before) continue;
    range_before = steps;
    const double range_m = kRangeStep_m * steps;
    const double horizontal_m = range_m * std::cos(channel.elevation_rad);
    LidarPoint point;
    point.x_m = static_cast<float>(horizontal_m * std::cos(heading_rad));
    point.y_m = static_cast<float>(horizontal_m * std::sin(heading_rad));
    point.z_m = static_cast<float>(range_m * std::sin(channel.elevation_rad));
    point.intensity = packet.payload[at + 2];
    point.ring = channel.ring;
    turn_.points.push_back(point);
    turn_.instants_ns.push_back(instant_ns);
  }
}

void VelodyneDecoder::Finish() {
  const Timestamp received = next_stamp_.value_or(Timestamp{});
  Cut(received);
}

}  // namespace lio
