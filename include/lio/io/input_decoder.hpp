// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Names of the channels, and the step from a channel's bytes to samples and chunks, which replay
// and the daemon share so that both count alike.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "lio/io/lcm_codec.hpp"

namespace lio {

inline constexpr const char* kDefaultChannelPrefix = "LIO_";

// Which of LOAM's sets a cloud holds; the order of Channels::features.
enum class FeatureSet { kCornerSharp, kCornerLessSharp, kSurfFlat, kSurfLessFlat, kRemoved };
inline constexpr std::size_t kNumFeatureSets = 5;

struct Channels {
  explicit Channels(const std::string& prefix = kDefaultChannelPrefix);

  std::string imu, scan, command;                                        // in
  std::string odometry, odometry_imu_rate, state, registration, status;  // out
  std::string odometry_local;                                            // out, in map
  std::string odometry_base, odometry_base_imu_rate;                     // out, with a base
  std::string cloud, cloud_full;
  std::array<std::string, kNumFeatureSets> features;  // by FeatureSet
};

// What was refused before the estimator saw it. Zero everywhere on a clean log.
struct InputCounters {
  std::array<std::int64_t, kNumDecodeStatuses> num_refused{};  // by DecodeStatus; kOk stays 0
  std::int64_t num_imu_missing = 0;  // holes in imu_t.seq: lost on the way here

  std::int64_t TotalRefused() const;
};

// Not for several threads at once.
class InputDecoder {
 public:
  // False when the bytes were refused, and counted.
  bool Imu(ByteView bytes, ImuSample& sample);
  bool Chunk(ByteView bytes, ScanChunk& chunk);
  // A message that was refused unread.
  void Refuse(DecodeStatus reason) { ++counters_.num_refused[static_cast<std::size_t>(reason)]; }

  const InputCounters& counters() const { return counters_; }

 private:
  bool Accept(DecodeStatus status);

  InputCounters counters_;
  bool has_imu_ = false;
  std::int32_t last_imu_seq_ = 0;
};

}  // namespace lio
