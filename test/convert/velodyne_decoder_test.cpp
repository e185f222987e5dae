// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/velodyne_decoder.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/velodyne_packets.hpp"

namespace lio {
namespace {

using test::ViewOf;

using test::SimulatedVelodyne;

const char* ModelOf(const SimulatedVelodyne& lidar) {
  return lidar.is_hdl32e ? "hdl32e" : "vlp16";
}

std::vector<Turn> Decode(const SimulatedVelodyne& lidar, double duration_s) {
  VelodyneDecoder decoder(ModelOf(lidar), HourClock{});
  for (double us = 0.0; us < 1e6 * duration_s; us += lidar.packet_us()) {
    decoder.Add(ViewOf(test::VelodynePacket(lidar, us)),
                lidar.begin + Duration::FromSeconds(1e-6 * us + 0.002));
  }
  decoder.Finish();
  EXPECT_EQ(decoder.counts().num_damaged, 0);
  EXPECT_EQ(decoder.counts().num_lost, 0);
  return decoder.TakeTurns();
}

// The place that the simulated beam hit, at the time that the decoder gives the point.
struct ExpectedPoint {
  double x_m, y_m, z_m;
};

ExpectedPoint Hit(const SimulatedVelodyne& lidar, const LidarPoint& point, double time_us,
                  bool is_far) {
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  const double azimuth = lidar.AzimuthDeg(time_us);
  double elevation = 0.0;
  for (int channel = 0; channel < lidar.num_channels(); ++channel) {
    const test::VelodyneBeam beam = lidar.Beam(channel);
    if (beam.ring == point.ring) elevation = beam.elevation_deg * kRadPerDeg;
  }
  const double range = lidar.RangeM(azimuth, point.ring, is_far);
  return {range * std::cos(elevation) * std::cos(azimuth * kRadPerDeg),
          -range * std::cos(elevation) * std::sin(azimuth * kRadPerDeg),
          range * std::sin(elevation)};
}

class Velodyne : public testing::TestWithParam<SimulatedVelodyne> {};

TEST_P(Velodyne, PointsAreWhereTheBeamsHitAndTimesAreThoseOfTheFirings) {
  const SimulatedVelodyne& lidar = GetParam();
  const std::vector<Turn> turns = Decode(lidar, 0.45);
  ASSERT_EQ(turns.size(), 5u);
  int num_far = 0;
  for (const Turn& turn : turns) {
    for (std::size_t i = 0; i < turn.points.size(); ++i) {
      const LidarPoint& point = turn.points[i];
      const double time_us = 1e-3 * static_cast<double>(turn.instants_ns[i] - lidar.begin.ns);
      const double range = std::hypot(point.x_m, point.y_m, point.z_m);
      const bool is_far = range > lidar.RangeM(lidar.AzimuthDeg(time_us), point.ring) + 2.5;
      num_far += is_far;
      const ExpectedPoint hit = Hit(lidar, point, time_us, is_far);
      // Half a step of the range is 1 mm, half a step of the azimuth 2 mm at 20 m; the time of a
      // packet, in whole us, turns the head by another 0.002 deg.
      const double error =
          std::hypot(point.x_m - hit.x_m, point.y_m - hit.y_m, point.z_m - hit.z_m);
      ASSERT_LT(error, 0.008) << "ring " << point.ring << " at " << time_us << " us";
      ASSERT_EQ(point.intensity, 10 + point.ring);
    }
  }
  EXPECT_EQ(num_far > 0, lidar.is_dual);
}

TEST_P(Velodyne, TimesAreRightToAMicrosecond) {
  const SimulatedVelodyne& lidar = GetParam();
  VelodyneDecoder decoder(ModelOf(lidar), HourClock{});
  decoder.Add(ViewOf(test::VelodynePacket(lidar, 0.0)), lidar.begin);
  decoder.Finish();
  const std::vector<Turn> turns = decoder.TakeTurns();
  ASSERT_EQ(turns.size(), 1u);
  std::vector<std::int64_t> wanted;
  for (int block = 0; block < 12; block += lidar.is_dual ? 2 : 1) {
    for (int index = 0; index < 32; ++index) {
      const int round = index / lidar.num_channels();
      const double us = block / (lidar.is_dual ? 2 : 1) * lidar.block_us() +
                        round * lidar.period_us() +
                        lidar.Beam(index % lidar.num_channels()).fire_us;
      wanted.insert(wanted.end(), lidar.is_dual && index % 3 == 0 ? 2 : 1,
                    lidar.begin.ns + std::llround(1e3 * us));
    }
  }
  ASSERT_EQ(turns[0].instants_ns.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(turns[0].instants_ns[i] - wanted[i]), 0.0, 1000.0) << i;
  }
}

TEST_P(Velodyne, TurnsAreCutAheadAndOnlyThoseInTheMiddleAreWhole) {
  const SimulatedVelodyne& lidar = GetParam();
  const std::vector<Turn> turns = Decode(lidar, 0.45);
  ASSERT_EQ(turns.size(), 5u);
  EXPECT_FALSE(turns.front().is_whole);
  EXPECT_FALSE(turns.back().is_whole);
  for (std::size_t k = 1; k + 1 < turns.size(); ++k) {
    EXPECT_TRUE(turns[k].is_whole);
    const double span_s =
        1e-9 * static_cast<double>(turns[k].instants_ns.back() - turns[k].instants_ns.front());
    EXPECT_NEAR(span_s, lidar.turn_s, 0.001);
    EXPECT_GT(turns[k].points.front().x_m, 0.0f);
    EXPECT_LT(std::abs(turns[k].points.front().y_m), 0.2f);
  }
}

TEST_P(Velodyne, DamageIsCountedAndNeverFollowed) {
  const SimulatedVelodyne& lidar = GetParam();
  VelodyneDecoder decoder(ModelOf(lidar), HourClock{});
  std::mt19937 random(5);
  std::uniform_int_distribution<int> any(0, 255);
  const std::string sound = test::VelodynePacket(lidar, 0.0);
  for (std::size_t size = 0; size <= sound.size(); size += 7) {
    decoder.Add(ViewOf(sound.substr(0, size)), lidar.begin);
  }
  EXPECT_EQ(decoder.counts().num_taken, 0);
  for (int k = 0; k < 500; ++k) {
    std::string noise = sound;
    for (int n = 0; n < 60; ++n) {
      noise[static_cast<std::size_t>(random()) % noise.size()] = static_cast<char>(any(random));
    }
    decoder.Add(ViewOf(noise), lidar.begin + Duration{k * 1'000'000});
  }
  decoder.Finish();
  EXPECT_EQ(decoder.counts().num_taken + decoder.counts().num_damaged, 500);
  EXPECT_GT(decoder.counts().num_damaged, 0);
  for (const Turn& turn : decoder.TakeTurns()) {
    for (const LidarPoint& point : turn.points) ASSERT_TRUE(std::isfinite(point.x_m));
  }
}

TEST_P(Velodyne, PacketsThatAreMissingAreCounted) {
  const SimulatedVelodyne& lidar = GetParam();
  VelodyneDecoder decoder(ModelOf(lidar), HourClock{});
  for (int k = 0; k < 40; ++k) {
    if (k >= 10 && k < 13) continue;
    const double us = k * lidar.packet_us();
    decoder.Add(ViewOf(test::VelodynePacket(lidar, us)),
                lidar.begin + Duration::FromSeconds(1e-6 * us));
  }
  EXPECT_EQ(decoder.counts().num_lost, 3);
}

INSTANTIATE_TEST_SUITE_P(Sensors, Velodyne,
                         testing::Values(SimulatedVelodyne{}, SimulatedVelodyne{.is_dual = true},
                                         SimulatedVelodyne{.is_hdl32e = true},
                                         SimulatedVelodyne{.is_hdl32e = true, .is_dual = true}),
                         [](const auto& tested) {
                           return std::string(ModelOf(tested.param)) +
                                  (tested.param.is_dual ? "Dual" : "Single");
                         });

TEST(VelodyneModel, SaysWhatADatagramIs) {
  std::string packet = test::VelodynePacket({}, 0.0);
  EXPECT_EQ(VelodyneModel(ViewOf(packet)), "vlp16");
  packet.back() = '\x28';
  EXPECT_EQ(VelodyneModel(ViewOf(packet)), "");
  EXPECT_EQ(VelodyneProduct(ViewOf(packet)), 0x28);
  packet[500] = '\0';  // the flag of a block
  EXPECT_FALSE(VelodyneModel(ViewOf(packet)));
  EXPECT_FALSE(VelodyneModel(ViewOf(packet.substr(1))));
}

TEST(HourClock, TheHourIsThatOfTheReception) {
  constexpr std::int64_t kHour = 3'600'000'000'000;
  const Timestamp noon{472'222 * kHour};
  EXPECT_EQ(HourClock{}.At(3'599'999'000, noon + Duration{1'000'000}), noon - Duration{1'000'000});
  EXPECT_EQ(HourClock{}.At(5, noon - Duration{1'000'000}), noon + Duration{5'000});
  const HourClock moved{Duration{kHour / 4}};
  EXPECT_EQ(moved.At(0, noon + Duration{kHour / 4}), noon + Duration{kHour / 4});
}

}  // namespace
}  // namespace lio
