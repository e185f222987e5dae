// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Simulates faults between a sensor and its log. A fault is written "kind:key=value,key=value",
// e.g. "imu_gap:start=10,duration=0.6"; times are seconds from the log's begin. The affected
// messages are drawn from the seed, so that the same faults hit the same messages on any number of
// threads.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lio/base/pose.hpp"
#include "lio/sim/lidar_simulator.hpp"
#include "lio/sim/messages.hpp"

namespace lio::sim {

enum class FaultKind {
  kImuGap,
  kLidarGap,
  kDrop,
  kDuplicate,
  kReorder,
  kChunkLoss,
  kStampJump,
  kClockOffset,
  kNan,
  kGyroSaturation,
  kShaking,
  kImuDead,
  kImuOffset,
  kEmptyScan,
  kSparseScan,
  kDust,
  kWrongExtrinsic,
};

enum class FaultChannel { kImu, kLidar, kBoth };

struct Fault {
  FaultKind kind = FaultKind::kImuGap;
  FaultChannel channel = FaultChannel::kBoth;
  std::map<std::string, double> values;  // holds every key of the kind

  [[nodiscard]] double Get(const std::string& key) const { return values.at(key); }
};

// Throws std::invalid_argument that says what is wrong and lists the valid kinds or keys.
[[nodiscard]] Fault ParseFault(const std::string& text);

// Lists the kinds with their keys and defaults, for --help.
[[nodiscard]] std::string DescribeFaults();

// Applies the faults that alter single messages.
class FaultInjector {
 public:
  // `begin` is the stamp of the log's begin.
  FaultInjector(std::vector<Fault> faults, std::uint64_t seed, Timestamp begin);

  // Returns what the log receives for one message: nothing, the message itself or several messages.
  [[nodiscard]] std::vector<Message> Apply(Message message) const;

 private:
  void ApplyOne(const Fault& fault, std::uint64_t fault_key, std::vector<Message>& messages) const;
  [[nodiscard]] bool InWindow(const Fault& fault, const Message& message) const;

  std::vector<Fault> faults_;
  std::uint64_t seed_;
  Timestamp begin_;
};

// The next two functions give the faults that do not alter single messages. `begin_s` is the
// trajectory time of the log's begin [s].
[[nodiscard]] std::vector<Dust> DustOf(const std::vector<Fault>& faults, double begin_s);
// Returns the extrinsic that the configuration claims.
[[nodiscard]] Pose ClaimedExtrinsic(const std::vector<Fault>& faults, const Pose& T_imu_lidar);

}  // namespace lio::sim
