// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/input_decoder.hpp"

#include <numeric>

namespace lio {

Channels::Channels(const std::string& prefix)
    : imu(prefix + "IMU"),
      scan(prefix + "SCAN"),
      command(prefix + "CMD"),
      reply(prefix + "REPLY"),
      odometry(prefix + "ODOM"),
      odometry_imu_rate(prefix + "ODOM_IMU"),
      state(prefix + "STATE"),
      registration(prefix + "REG"),
      status(prefix + "STATUS"),
      odometry_local(prefix + "ODOM_LOCAL"),
      odometry_base(prefix + "ODOM_BASE"),
      odometry_base_imu_rate(prefix + "ODOM_BASE_IMU"),
      cloud(prefix + "CLOUD"),
      cloud_full(prefix + "CLOUD_FULL"),
      features{prefix + "CORNER_SHARP", prefix + "CORNER_LESS_SHARP", prefix + "SURF_FLAT",
               prefix + "SURF_LESS_FLAT", prefix + "REMOVED"} {}

std::int64_t InputCounters::TotalRefused() const {
  return std::accumulate(num_refused.begin(), num_refused.end(), std::int64_t{0});
}

bool InputDecoder::Accept(DecodeStatus status,
                          std::array<std::int64_t, kNumDecodeStatuses>& of_channel) {
  if (status == DecodeStatus::kOk) return true;
  Refuse(status);
  ++of_channel[static_cast<std::size_t>(status)];
  return false;
}

bool InputDecoder::Imu(ByteView bytes, ImuSample& sample) {
  std::int32_t seq = 0;
  ++counters_.num_imu_received;
  if (!Accept(DecodeImu(bytes, sample, seq), counters_.num_imu_refused)) return false;
  ++counters_.num_imu_taken;
  sample.seq = seq;
  imu_holes_.Add(seq);
  counters_.num_imu_missing = imu_holes_.num_missing();
  return true;
}

bool InputDecoder::Chunk(ByteView bytes, ScanChunk& chunk) {
  ++counters_.num_chunks_received;
  if (!Accept(DecodeChunk(bytes, chunk), counters_.num_chunks_refused)) return false;
  ++counters_.num_chunks_taken;
  return true;
}

}  // namespace lio
