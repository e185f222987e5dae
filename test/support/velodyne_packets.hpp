// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Simulates a Velodyne that stands in a round room with waves in its wall, and encodes its packets
// as its manual says. The beams' angles and firing times are those of the manual, written down here
// by themselves.
#pragma once

#include <cmath>
#include <numbers>

#include "support/capture_writer.hpp"

namespace lio::test {

struct VelodyneBeam {
  double elevation_deg = 0.0;
  double fire_us = 0.0;
  int ring = 0;
};

struct SimulatedVelodyne {
  bool is_hdl32e = false;
  bool is_dual = false;
  double turn_s = 0.1;
  Timestamp begin{1'700'000'000'000'000'000};  // 13 minutes and 20 s past the hour

  [[nodiscard]] double period_us() const { return is_hdl32e ? 46.08 : 55.296; }
  [[nodiscard]] int num_channels() const { return is_hdl32e ? 32 : 16; }
  [[nodiscard]] double block_us() const { return is_hdl32e ? period_us() : 2.0 * period_us(); }
  [[nodiscard]] double packet_us() const { return block_us() * (is_dual ? 6 : 12); }

  // Channels alternate between the lower and the upper half of the beams.
  [[nodiscard]] VelodyneBeam Beam(int channel) const {
    VelodyneBeam beam;
    beam.ring = channel % 2 == 0 ? channel / 2 : num_channels() / 2 + channel / 2;
    beam.elevation_deg = is_hdl32e ? -30.667 + beam.ring * 4.0 / 3.0 : -15.0 + 2.0 * beam.ring;
    beam.fire_us = channel * (is_hdl32e ? 1.152 : 2.304);
    return beam;
  }
  // Returns the azimuth clockwise from straight ahead, at a time since the beginning.
  [[nodiscard]] double AzimuthDeg(double time_us) const {
    return std::fmod(100.0 + 360e-6 / turn_s * time_us, 360.0);
  }
  [[nodiscard]] double RangeM(double azimuth_deg, int ring, bool is_far = false) const {
    return 12.0 + 2.0 * std::cos(3.0 * azimuth_deg * std::numbers::pi / 180.0) + 0.1 * ring +
           (is_far ? 5.0 : 0.0);
  }
};

// The packet that begins so long after the beginning. In dual mode every third firing has a second
// return behind the first.
inline std::string VelodynePacket(const SimulatedVelodyne& lidar, double packet_us) {
  PacketBytes packet;
  const int returns = lidar.is_dual ? 2 : 1;
  for (int block = 0; block < 12; ++block) {
    const double begin_us = packet_us + block / returns * lidar.block_us();
    packet.Little(std::uint16_t{0xeeff});
    packet.Little(static_cast<std::uint16_t>(
        static_cast<int>(std::lround(100.0 * lidar.AzimuthDeg(begin_us))) % 36'000));
    for (int index = 0; index < 32; ++index) {
      const int round = index / lidar.num_channels();
      const VelodyneBeam beam = lidar.Beam(index % lidar.num_channels());
      const double azimuth_deg =
          lidar.AzimuthDeg(begin_us + round * lidar.period_us() + beam.fire_us);
      const bool is_far = lidar.is_dual && block % 2 == 1 && index % 3 == 0;
      const double range_m = lidar.RangeM(azimuth_deg, beam.ring, is_far);
      packet.Little(static_cast<std::uint16_t>(std::lround(range_m / 0.002)));
      packet.Little(static_cast<std::uint8_t>(10 + beam.ring));
    }
  }
  const std::int64_t us = lidar.begin.ns / 1000 + std::llround(packet_us);
  packet.Little(static_cast<std::uint32_t>(us % 3'600'000'000));
  packet.Little(static_cast<std::uint8_t>(lidar.is_dual ? 0x39 : 0x37));
  packet.Little(static_cast<std::uint8_t>(lidar.is_hdl32e ? 0x21 : 0x22));
  return packet.bytes;
}

}  // namespace lio::test
