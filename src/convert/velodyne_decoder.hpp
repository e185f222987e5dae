// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Decodes the data packets of Velodyne's VLP-16 (also Puck LITE) and HDL-32E. A packet has twelve
// blocks of 32 ranges, each with the head's azimuth at its first firing, and ends with the time of
// its first firing [us since the hour], the mode of returns and the product.
//
// The azimuth of each firing is that of its block, turned on at the packet's mean rate. The beams
// are taken to leave the origin: those of a VLP-16 leave up to 11 mm above or below it.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "convert/firing_table.hpp"
#include "convert/packet_sweeps.hpp"

namespace lio {

// Says what a datagram is: nothing for other data, "" for a Velodyne that is not supported, else
// the name of its model in config/lidars.
[[nodiscard]] std::optional<std::string> VelodyneModel(ByteView payload);
// Returns the product's number in a data packet, for messages to users.
[[nodiscard]] int VelodyneProduct(ByteView payload);

// The sensor's clock: it tells the time since the hour. Without GPS it began when it was switched
// on; then `offset` moves it to the clock of the host.
struct HourClock {
  Duration offset{0};

  // Returns the instant with that time since an hour that is nearest to when it was received.
  [[nodiscard]] Timestamp At(std::uint32_t since_hour_us, Timestamp received) const;
};
[[nodiscard]] std::uint32_t VelodyneTime(ByteView payload);

class VelodyneDecoder : public PacketDecoder {
 public:
  VelodyneDecoder(const std::string& model, HourClock clock);

  void Add(ByteView payload, Timestamp received) override;
  void Finish() override;

 private:
  static constexpr int kNumBlocks = 12;
  struct Packet {
    ByteView payload;
    Timestamp stamp, received;
    int blocks_per_firing = 1;                        // 2: both returns have a block each
    std::array<double, kNumBlocks> azimuth_rad = {};  // clockwise
  };

  [[nodiscard]] std::optional<Packet> Read(ByteView payload, Timestamp received) const;
  void NoteGap(const Packet& packet);
  [[nodiscard]] double RateOf(const Packet& packet) const;
  void BeginBlock(double azimuth_rad, const Packet& packet);
  void AddBlock(const Packet& packet, int block);
  void AddReturns(const Packet& packet, int block, int index, double azimuth_rad,
                  std::int64_t instant_ns);
  void Cut(Timestamp received);

  FiringTable table_;
  HourClock clock_;
  double block_s_ = 0.0;                 // from one block to the next
  double rate_radps_ = 0.0;              // turn rate of the head, clockwise
  std::optional<Timestamp> next_stamp_;  // due time of the next packet
  std::optional<double> last_azimuth_rad_;
  double turned_rad_ = 0.0;  // since the turn began
  Turn turn_;
};

}  // namespace lio
