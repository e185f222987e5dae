// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/clock_errors.hpp"

#include <algorithm>
#include <cmath>

#include "lio/sim/random.hpp"

namespace lio::sim {
namespace {

constexpr double kMaxJitter = 3.0;  // sigma: stamps of one stream stay in order

// Returns whole microseconds, as stamps have on the wire.
Duration Jitter(std::uint64_t seed, std::uint64_t stream, double std_s) {
  if (std_s <= 0.0) return Duration{0};
  Random random(seed, Purpose::kClock, stream);
  const double sigmas = std::clamp(random.Gaussian(), -kMaxJitter, kMaxJitter);
  return Duration{1000 * std::llround(1e6 * std_s * sigmas)};
}

}  // namespace

Clocks::Clocks(const ClockErrors& errors, std::uint64_t seed, Timestamp begin)
    : errors_(errors),
      seed_(seed),
      begin_(begin),
      drift_ratio_(errors.drift_std_ratio * Random(seed, Purpose::kClock).Gaussian()) {}

void Clocks::Stamp(Message& message) const {
  if (auto* imu = std::get_if<ImuMessage>(&message.body)) {
    const std::uint64_t stream = HashKey({1, static_cast<std::uint64_t>(imu->seq)});
    imu->sample.stamp = imu->sample.stamp + Jitter(seed_, stream, errors_.imu_jitter_std_s);
    return;
  }
  auto& chunk = std::get<ScanChunk>(message.body);
  const std::uint64_t stream = HashKey({2, static_cast<std::uint64_t>(chunk.scan_seq),
                                        static_cast<std::uint64_t>(chunk.chunk_index)});
  const double since_s = SecondsBetween(begin_, chunk.stamp);
  const Duration drift{std::llround(1e9 * drift_ratio_ * since_s)};
  chunk.stamp = chunk.stamp + drift + Jitter(seed_, stream, errors_.lidar_jitter_std_s);
}

}  // namespace lio::sim
