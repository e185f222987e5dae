// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The decoders of a lidar's packets share this: points are gathered until a turn is complete.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "lio/base/time.hpp"
#include "lio/io/lcm_codec.hpp"
#include "lio/sensor/imu_sample.hpp"
#include "lio/sensor/scan_chunk.hpp"

namespace lio {

inline constexpr double kWholeTurn = 0.9;  // share of a turn that makes it a whole one

struct Turn {
  std::vector<LidarPoint> points;
  std::vector<std::int64_t> instants_ns;  // one a point
  Timestamp received;                     // when the packet came that completed it
  bool is_whole = true;                   // false: begun or ended by the capture, or by a gap
};

struct ReceivedImu {
  ImuSample sample;
  Timestamp received;
};

struct PacketCounts {
  std::int64_t num_taken = 0;
  std::int64_t num_damaged = 0;  // right in size, but their content contradicts the format
  std::int64_t num_lost = 0;     // never came, as the times or numbers of their neighbours show
};

class PacketDecoder {
 public:
  virtual ~PacketDecoder() = default;
  // Takes a datagram of the chosen sensor; those of another size are passed over.
  virtual void Add(ByteView payload, Timestamp received) = 0;
  // Completes the turn that is under way; to be called once, at the end.
  virtual void Finish() = 0;

  [[nodiscard]] std::vector<Turn> TakeTurns() { return std::exchange(turns_, {}); }
  [[nodiscard]] std::vector<ReceivedImu> TakeImu() { return std::exchange(imu_, {}); }
  [[nodiscard]] const PacketCounts& counts() const { return counts_; }

 protected:
  std::vector<Turn> turns_;
  std::vector<ReceivedImu> imu_;
  PacketCounts counts_;
};

}  // namespace lio
