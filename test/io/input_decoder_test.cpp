// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/input_decoder.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lio {
namespace {

Bytes Imu(std::int32_t seq) {
  return EncodeImu({}, seq);
}

TEST(InputDecoder, RefusalsAreCountedByReason) {
  InputDecoder decoder;
  ImuSample sample;
  ScanChunk chunk;
  EXPECT_TRUE(decoder.Imu(Imu(0), sample));
  EXPECT_FALSE(decoder.Imu(EncodeChunk({}), sample));
  EXPECT_FALSE(decoder.Chunk(Bytes(3), chunk));
  EXPECT_FALSE(decoder.Chunk(Bytes(3), chunk));
  decoder.Refuse(DecodeStatus::kTooLarge);
  const auto& refused = decoder.counters().num_refused;
  EXPECT_EQ(refused[static_cast<std::size_t>(DecodeStatus::kWrongType)], 1);
  EXPECT_EQ(refused[static_cast<std::size_t>(DecodeStatus::kTruncated)], 2);
  EXPECT_EQ(refused[static_cast<std::size_t>(DecodeStatus::kTooLarge)], 1);
  EXPECT_EQ(refused[static_cast<std::size_t>(DecodeStatus::kOk)], 0);
  EXPECT_EQ(decoder.counters().TotalRefused(), 4);
}

TEST(InputDecoder, HolesInTheSequenceAreCountedExactly) {
  InputDecoder decoder;
  ImuSample sample;
  for (const std::int32_t seq : {5, 6, 9, 10}) (void)decoder.Imu(Imu(seq), sample);
  EXPECT_EQ(decoder.counters().num_imu_missing, 2);
}

TEST(InputDecoder, DuplicatesRestartsAndWrapsAreNoHoles) {
  InputDecoder decoder;
  ImuSample sample;
  constexpr std::int32_t kLast = std::numeric_limits<std::int32_t>::max();
  for (const std::int32_t seq : {100, 100, 99, 3, kLast, kLast - 1, kLast}) {
    EXPECT_TRUE(decoder.Imu(Imu(seq), sample));
  }
  EXPECT_TRUE(decoder.Imu(Imu(std::numeric_limits<std::int32_t>::min()), sample));
  EXPECT_EQ(decoder.counters().num_imu_missing, 0);
}

TEST(InputDecoder, OneFalseNumberIsNoHole) {
  InputDecoder decoder;
  ImuSample sample;
  for (const std::int32_t seq : {5, 6, 9999, 7, 8}) EXPECT_TRUE(decoder.Imu(Imu(seq), sample));
  EXPECT_EQ(decoder.counters().num_imu_missing, 0);
}

TEST(Channels, NamesFollowThePrefix) {
  EXPECT_EQ(Channels().odometry_imu_rate, "LIO_ODOM_IMU");
  EXPECT_EQ(Channels("FRONT_").scan, "FRONT_SCAN");
}

}  // namespace
}  // namespace lio
