// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/clock_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lio::sim {
namespace {

Message ImuStampedAt(std::int64_t t_ns, std::int32_t seq) {
  ImuMessage imu;
  imu.sample.stamp = {t_ns};
  imu.seq = seq;
  return {{t_ns}, imu};
}

Message ChunkStampedAt(std::int64_t t_ns, std::int32_t seq) {
  ScanChunk chunk;
  chunk.stamp = {t_ns};
  chunk.scan_seq = seq;
  return {{t_ns}, chunk};
}

Timestamp StampOf(const Message& message) {
  if (const auto* imu = std::get_if<ImuMessage>(&message.body)) return imu->sample.stamp;
  return std::get<ScanChunk>(message.body).stamp;
}

double OffSeconds(const Clocks& clocks, Message message) {
  const Timestamp before = StampOf(message);
  clocks.Stamp(message);
  return SecondsBetween(before, StampOf(message));
}

TEST(Clocks, WithoutErrorsStampsStay) {
  const Clocks clocks({}, 1, {0});
  EXPECT_EQ(OffSeconds(clocks, ImuStampedAt(5'000'000'000, 3)), 0.0);
  EXPECT_EQ(OffSeconds(clocks, ChunkStampedAt(5'000'000'000, 3)), 0.0);
}

TEST(Clocks, StampsJitterByWholeMicrosecondsInOrder) {
  const Clocks clocks({2e-4, 1e-4, 0.0}, 1, {0});
  double imu_sq = 0.0;
  double lidar_sq = 0.0;
  for (std::int32_t i = 0; i < 2000; ++i) {
    const double imu = OffSeconds(clocks, ImuStampedAt(1'000'000 * std::int64_t{i}, i));
    const double lidar = OffSeconds(clocks, ChunkStampedAt(1'000'000 * std::int64_t{i}, i));
    EXPECT_NEAR(1e6 * imu, std::round(1e6 * imu), 1e-6);
    EXPECT_LE(std::abs(imu), 6.01e-4);
    imu_sq += imu * imu;
    lidar_sq += lidar * lidar;
  }
  EXPECT_NEAR(std::sqrt(imu_sq / 2000), 2e-4, 1e-5);
  EXPECT_NEAR(std::sqrt(lidar_sq / 2000), 1e-4, 5e-6);
}

TEST(Clocks, TheLidarsDriftsByPartsPerMillion) {
  double sum_sq = 0.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Clocks clocks({0.0, 0.0, 2e-5}, seed, {0});
    EXPECT_NEAR(OffSeconds(clocks, ChunkStampedAt(60'000'000'000, 1)), 60.0 * clocks.drift_ratio(),
                1e-9);
    EXPECT_EQ(OffSeconds(clocks, ChunkStampedAt(0, 1)), 0.0);
    EXPECT_EQ(OffSeconds(clocks, ImuStampedAt(60'000'000'000, 1)), 0.0);
    sum_sq += clocks.drift_ratio() * clocks.drift_ratio();
  }
  EXPECT_NEAR(std::sqrt(sum_sq / 200), 2e-5, 3e-6);
}

}  // namespace
}  // namespace lio::sim
