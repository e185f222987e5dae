// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/ouster_decoder.hpp"

#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <numbers>
#include <random>

#include "lio/io/input_error.hpp"
#include "support/capture_writer.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using test::ViewOf;

using test::PacketBytes;

constexpr std::size_t kBeams = 4;  // the format has as many as the metadata says
constexpr int kColumns = 512;
constexpr std::int64_t kBeginNs = 1'700'000'000'000'000'000;
constexpr std::int64_t kColumnNs = 195'312;

std::string Metadata(const std::string& profile) {
  return R"({"beam_intrinsics": {"beam_altitude_angles": [15.0, 5.0, -5.0, -15.0],
    "beam_azimuth_angles": [3.0, 1.0, -1.0, -3.0], "lidar_origin_to_beam_origin_mm": 12.163},
    "config_params": {"lidar_mode": "512x10"}, "lidar_data_format": {"columns_per_frame": 512,
    "columns_per_packet": 16, "udp_profile_lidar": ")" +
         profile + R"("}, "lidar_intrinsics": {"lidar_to_sensor_transform":
    [-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36.18, 0, 0, 0, 1]}, "imu_intrinsics":
    {"imu_to_sensor_transform": [1, 0, 0, 6.253, 0, 1, 0, -11.775, 0, 0, 1, 7.645, 0, 0, 0, 1]}})";
}

std::uint32_t RangeMm(int column, std::size_t beam) {
  return 8'000 + 10 * static_cast<std::uint32_t>(column) + static_cast<std::uint32_t>(beam);
}

// Columns are counted over all turns.
std::string LidarPacket(OusterProfile profile, int first_column) {
  const bool is_legacy = profile == OusterProfile::kLegacy;
  PacketBytes packet;
  const auto frame = static_cast<std::uint16_t>(first_column / kColumns);
  if (!is_legacy) packet.Little(std::uint16_t{1}).Little(frame).Put(std::string(28, '\0'));
  for (int i = 0; i < 16; ++i) {
    const int column = first_column + i;
    packet.Little(static_cast<std::uint64_t>(kBeginNs + kColumnNs * column));
    packet.Little(static_cast<std::uint16_t>(column % kColumns));
    if (is_legacy) packet.Little(frame).Little(0u);
    if (!is_legacy) packet.Little(std::uint16_t{1});
    for (std::size_t beam = 0; beam < kBeams; ++beam) {
      packet.Little(RangeMm(column % kColumns, beam) | (is_legacy ? 0u : 0xf8000000u));
      if (is_legacy) packet.Little(std::uint16_t{77}).Little(std::uint16_t{9});
      if (!is_legacy)
        packet.Little(std::uint8_t{77}).Little(std::uint8_t{0}).Little(std::uint16_t{9});
      packet.Little(0u);
    }
    if (is_legacy) packet.Little(0xffffffffu);
  }
  if (!is_legacy) packet.Put(std::string(32, '\0'));
  return packet.bytes;
}

class Ouster : public testing::TestWithParam<OusterProfile> {
 protected:
  OusterMetadata Read() {
    const bool is_legacy = GetParam() == OusterProfile::kLegacy;
    return ReadOusterMetadata(
        dir_.Write("os.json", Metadata(is_legacy ? "LEGACY" : "RNG19_RFL8_SIG16_NIR16")));
  }

  test::TempDir dir_;
};

TEST_P(Ouster, PointsAreWhereTheSensorsManualPutsThem) {
  OusterDecoder decoder(Read());
  for (int column = 0; column < 3 * kColumns; column += 16) {
    decoder.Add(ViewOf(LidarPacket(GetParam(), column)), Timestamp{kBeginNs + column * kColumnNs});
  }
  decoder.Finish();
  const std::vector<Turn> turns = decoder.TakeTurns();
  ASSERT_EQ(turns.size(), 3u);
  EXPECT_EQ(decoder.counts().num_taken, 96);
  const Turn& turn = turns[1];
  EXPECT_TRUE(turn.is_whole);
  ASSERT_EQ(turn.points.size(), kColumns * kBeams);
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  const std::array<double, kBeams> altitude_deg = {15.0, 5.0, -5.0, -15.0};
  const std::array<double, kBeams> azimuth_deg = {3.0, 1.0, -1.0, -3.0};
  for (std::size_t i = 0; i < turn.points.size(); ++i) {
    const std::size_t beam = i % kBeams;
    const int column = static_cast<int>(i / kBeams);
    const double head = 2.0 * std::numbers::pi * (1.0 - static_cast<double>(column) / kColumns);
    const double turned = head - azimuth_deg[beam] * kRadPerDeg;
    const double leg = 1e-3 * (RangeMm(column, beam) - 12.163);
    const double flat = leg * std::cos(altitude_deg[beam] * kRadPerDeg);
    // The sensor's frame is turned by half a turn about z, and 36.18 mm lower.
    EXPECT_NEAR(turn.points[i].x_m, -(flat * std::cos(turned) + 0.012163 * std::cos(head)), 1e-4);
    EXPECT_NEAR(turn.points[i].y_m, -(flat * std::sin(turned) + 0.012163 * std::sin(head)), 1e-4);
    EXPECT_NEAR(turn.points[i].z_m, leg * std::sin(altitude_deg[beam] * kRadPerDeg) + 0.03618,
                1e-4);
    EXPECT_EQ(turn.points[i].ring, kBeams - 1 - beam);
    EXPECT_EQ(turn.points[i].intensity, 77);
    EXPECT_EQ(turn.instants_ns[i], kBeginNs + kColumnNs * (kColumns + column));
  }
}

TEST_P(Ouster, DamageIsCountedAndNeverFollowed) {
  OusterDecoder decoder(Read());
  const std::string sound = LidarPacket(GetParam(), 0);
  std::mt19937 random(2);
  for (std::size_t size = 0; size < sound.size(); ++size) {
    if (size != kOusterImuBytes) decoder.Add(ViewOf(sound.substr(0, size)), Timestamp{1});
  }
  EXPECT_EQ(decoder.counts().num_taken, 0);
  for (int k = 0; k < 500; ++k) {
    std::string noise = sound;
    for (int n = 0; n < 40; ++n) noise[random() % noise.size()] = static_cast<char>(random());
    decoder.Add(ViewOf(noise), Timestamp{1});
  }
  EXPECT_EQ(decoder.counts().num_taken + decoder.counts().num_damaged, 500);
}

// A turn of columns of any time would have no span that 32 bits of nanoseconds hold.
TEST_P(Ouster, ColumnsAndSamplesOfAnotherTimeAreDamaged) {
  OusterDecoder decoder(Read());
  const std::string sound = LidarPacket(GetParam(), 0);
  decoder.Add(ViewOf(sound), Timestamp{1});
  const std::size_t stamp_at = GetParam() == OusterProfile::kLegacy ? 0 : 32;
  for (const char high : {'\x00', '\x7f', '\xff'}) {
    std::string packet = sound;
    packet[stamp_at + 7] = high;
    decoder.Add(ViewOf(packet), Timestamp{1});
  }
  EXPECT_EQ(decoder.counts().num_taken, 1);
  EXPECT_EQ(decoder.counts().num_damaged, 3);
  decoder.Add(ViewOf(std::string(kOusterImuBytes, '\xff')), Timestamp{1});
  EXPECT_EQ(decoder.counts().num_damaged, 4);
  decoder.Finish();
  EXPECT_EQ(decoder.TakeTurns().at(0).points.size(), kBeams * (16 + 3 * 15));
  EXPECT_TRUE(decoder.TakeImu().empty());
}

TEST_P(Ouster, ItsImuIsInMetresAndRadians) {
  OusterDecoder decoder(Read());
  PacketBytes packet;
  packet.Little(std::uint64_t{1}).Little(std::uint64_t{2}).Little(std::uint64_t{1'234'567});
  for (const float value : {0.0f, 0.5f, 1.0f, 90.0f, 0.0f, -180.0f}) {
    packet.Little(std::bit_cast<std::uint32_t>(value));
  }
  decoder.Add(ViewOf(packet.bytes), Timestamp{99});
  const auto imu = decoder.TakeImu();
  ASSERT_EQ(imu.size(), 1u);
  EXPECT_EQ(imu[0].sample.stamp, Timestamp{1'234'567});
  EXPECT_NEAR(imu[0].sample.f_imu_mps2.z(), 9.80665, 1e-6);
  EXPECT_NEAR(imu[0].sample.w_imu_radps.z(), -std::numbers::pi, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Profiles, Ouster,
                         testing::Values(OusterProfile::kLegacy, OusterProfile::kRng19),
                         [](const auto& tested) {
                           return tested.param == OusterProfile::kLegacy ? "Legacy" : "Rng19";
                         });

// Hostile: a section in a section, and so on.
std::string DeepSections(int depth) {
  std::string text;
  for (int i = 0; i < depth; ++i) text += "{\"a\":";
  return text + "1" + std::string(static_cast<std::size_t>(depth), '}');
}

TEST(OusterMetadata, FlatFilesAndDefaultsAreRead) {
  const test::TempDir dir;
  const OusterMetadata sensor = ReadOusterMetadata(
      dir.Write("old.json", R"({"lidar_mode": "1024x10", "beam_altitude_angles": [1, -1],
                               "beam_azimuth_angles": [0, 0]})"));
  EXPECT_EQ(sensor.profile, OusterProfile::kLegacy);
  EXPECT_EQ(sensor.columns_per_turn, 1024u);
  EXPECT_EQ(sensor.PacketBytes(), 16u * (16 + 24 + 4));
}

TEST(OusterMetadata, WhatCannotBeUsedIsRefusedByName) {
  const test::TempDir dir;
  for (const auto& [text, says] : std::vector<std::pair<std::string, std::string>>{
           {"", "no description"},
           {"[]", "no description"},
           {DeepSections(100'000), "no description"},
           {"{\"beam_altitude_angles\": []}", "no description"},
           {Metadata("RNG15_RFL8_NIR8"), "RNG15_RFL8_NIR8 is not supported"},
           {R"({"lidar_mode": "0x10", "beam_altitude_angles": [1], "beam_azimuth_angles": [0]})",
            "do not fit"}}) {
    try {
      (void)ReadOusterMetadata(dir.Write("os.json", text));
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(says));
      EXPECT_THAT(error.what(), testing::HasSubstr("os.json"));
    }
  }
}

}  // namespace
}  // namespace lio
