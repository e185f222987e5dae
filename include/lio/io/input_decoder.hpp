// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Names the channels and decodes the input channels, which lio-replay and liod share so that both
// count alike.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "lio/io/lcm_codec.hpp"
#include "lio/io/sequence_holes.hpp"

namespace lio {

inline constexpr const char* kDefaultChannelPrefix = "LIO_";

// Names the feature set of LOAM that a cloud holds; in the order of Channels::features.
enum class FeatureSet { kCornerSharp, kCornerLessSharp, kSurfFlat, kSurfLessFlat, kRemoved };
inline constexpr std::size_t kNumFeatureSets = 5;

struct Channels {
  explicit Channels(const std::string& prefix = kDefaultChannelPrefix);

  std::string imu, scan, command;                                        // in
  std::string reply;                                                     // out, to a command
  std::string odometry, odometry_imu_rate, state, registration, status;  // out
  std::string odometry_local;                                            // out, in map
  std::string odometry_base, odometry_base_imu_rate;                     // out, with a base
  std::string cloud, cloud_full;
  std::array<std::string, kNumFeatureSets> features;  // by FeatureSet
};

// Messages as they arrived, before the estimator saw them. On a clean log all were taken.
struct InputCounters {
  std::int64_t num_imu_received = 0;  // messages of the channel, refused ones included
  std::int64_t num_imu_taken = 0;     // not refused
  std::int64_t num_chunks_received = 0;
  std::int64_t num_chunks_taken = 0;
  std::array<std::int64_t, kNumDecodeStatuses> num_refused{};  // by DecodeStatus; kOk stays 0
  // These count the same for one channel. Messages that the bus found too large are in neither,
  // since nobody looked at their channel.
  std::array<std::int64_t, kNumDecodeStatuses> num_imu_refused{};
  std::array<std::int64_t, kNumDecodeStatuses> num_chunks_refused{};
  std::int64_t num_imu_missing = 0;  // gaps in imu_t.seq: lost before they arrived

  [[nodiscard]] std::int64_t TotalRefused() const;
};

// Serves one thread at a time.
class InputDecoder {
 public:
  // Returns false when the bytes were refused, which is counted.
  [[nodiscard]] bool Imu(ByteView bytes, ImuSample& sample);
  [[nodiscard]] bool Chunk(ByteView bytes, ScanChunk& chunk);
  // Counts a message that was refused unread.
  void Refuse(DecodeStatus reason) { ++counters_.num_refused[static_cast<std::size_t>(reason)]; }

  [[nodiscard]] const InputCounters& counters() const { return counters_; }

 private:
  [[nodiscard]] bool Accept(DecodeStatus status,
                            std::array<std::int64_t, kNumDecodeStatuses>& of_channel);

  InputCounters counters_;
  SequenceHoles imu_holes_;
};

}  // namespace lio
