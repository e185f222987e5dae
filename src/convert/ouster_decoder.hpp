// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Decodes the lidar packets of an Ouster sensor (profiles LEGACY and RNG19_RFL8_SIG16_NIR16) and
// its IMU packets. Points are given in the sensor's frame, and inertial samples in that of its IMU,
// in m/s^2 and rad/s, all by the sensor's own clock.
#pragma once

#include <optional>

#include "convert/ouster_metadata.hpp"
#include "convert/packet_sweeps.hpp"

namespace lio {

inline constexpr std::size_t kOusterImuBytes = 48;

class OusterDecoder : public PacketDecoder {
 public:
  explicit OusterDecoder(OusterMetadata metadata);

  void Add(ByteView payload, Timestamp received) override;
  void Finish() override { Cut(last_received_); }

 private:
  struct Column {
    std::int64_t stamp_ns = 0;
    std::uint16_t number = 0;  // 0 .. columns_per_turn - 1
    std::uint16_t frame = 0;   // counts turns
    bool is_valid = false;
    ByteView pixels;
  };

  [[nodiscard]] Column ReadColumn(ByteView payload, std::size_t index) const;
  [[nodiscard]] bool IsInTime(const Column& column) const;
  void AddColumn(const Column& column, Timestamp received);
  void AddPixel(const Column& column, std::size_t beam);
  void AddImu(ByteView payload, Timestamp received);
  void Cut(Timestamp received);

  OusterMetadata metadata_;
  std::vector<std::uint16_t> ring_of_beam_;
  std::optional<std::uint16_t> frame_;
  std::size_t num_columns_ = 0;  // valid ones of this turn
  Timestamp last_received_;
  Turn turn_;
};

}  // namespace lio
