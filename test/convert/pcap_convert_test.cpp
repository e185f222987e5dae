// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/pcap_convert.hpp"

#include <gmock/gmock.h>

#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "support/lio_log.hpp"
#include "support/temp_dir.hpp"
#include "support/velodyne_packets.hpp"

namespace lio {
namespace {

using test::CaptureWriter;
using test::SimulatedVelodyne;
using testing::HasSubstr;

constexpr Duration kDelay{1'500'000};

// Adds half a second of the lidar, whose clock differs from the host's by `offset`.
void AddLidar(const SimulatedVelodyne& lidar, CaptureWriter& writer, Duration offset = {},
              std::uint32_t source = test::kSensorAddress) {
  for (double us = 0.0; us < 0.5e6; us += lidar.packet_us()) {
    const Timestamp sent = lidar.begin + Duration::FromSeconds(1e-6 * (us + lidar.packet_us()));
    writer.Udp(sent + kDelay + offset, test::VelodynePacket(lidar, us), 2368, source);
  }
}

class PcapConvert : public testing::Test {
 protected:
  PcapReport Convert(const CaptureWriter& writer) {
    options_.input = dir_.Write("drive.pcap", writer.bytes());
    options_.output = dir_.path() / "out.lcm";
    EXPECT_EQ(KindOf(options_.input), FileKind::kCapture);
    PcapReport report = ConvertPcap(options_);
    EXPECT_FALSE(FormatReport(report, options_).empty());
    return report;
  }
  std::string WhyRefused(const CaptureWriter& writer) {
    try {
      (void)Convert(writer);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  test::TempDir dir_;
  PcapOptions options_;
};

TEST_F(PcapConvert, WholeTurnsAndTheImuBesideBecomeALog) {
  CaptureWriter writer;
  const SimulatedVelodyne lidar;
  AddLidar(lidar, writer);
  std::string table;
  for (int k = 0; k < 50; ++k) {
    const Timestamp stamp = lidar.begin + Duration{k * 10'000'000};
    table += std::to_string(stamp.ns) + ",0,0,0.1,0,0,9.8\n";
  }
  dir_.Write("drive.imu.csv", table);
  const PcapReport report = Convert(writer);
  EXPECT_FALSE(report.IsDamaged());
  EXPECT_EQ(report.model, "vlp16");
  EXPECT_EQ(report.sensor, "192.168.1.201:2368");
  EXPECT_THAT(report.clock_text, HasSubstr("GPS"));
  EXPECT_EQ(report.num_parts_of_turns, 2);
  const test::LioLog log = test::ReadLioLog(options_.output);
  EXPECT_EQ(log.sweeps.size(), 4u);
  EXPECT_EQ(log.imu.size(), 50u);
  EXPECT_NEAR(static_cast<double>(log.sweeps[1].points.size()), 1e6 * lidar.turn_s * 16 / 55.296,
              400.0);
}

TEST_F(PcapConvert, AClockWithoutGpsIsMovedToTheHosts) {
  CaptureWriter writer;
  const SimulatedVelodyne lidar;
  AddLidar(lidar, writer, Duration{1'000'000'000'000});
  const PcapReport report = Convert(writer);
  EXPECT_THAT(report.clock_text, HasSubstr("not set by GPS"));
  const test::LioLog log = test::ReadLioLog(options_.output);
  // The packet that was heard soonest came its own length and the delay after its stamp.
  const double late_s = 1e-6 * lidar.packet_us() + kDelay.Seconds();
  const double moved_s =
      1e-9 * static_cast<double>(log.sweeps[0].points[0].instant_ns - lidar.begin.ns) - 1000.0;
  EXPECT_GT(moved_s, late_s);
  EXPECT_LT(moved_s, late_s + 0.2);
}

TEST_F(PcapConvert, OtherSendersPortsAndKindsAreCounted) {
  CaptureWriter writer;
  const SimulatedVelodyne lidar;
  AddLidar(lidar, writer);
  for (int k = 0; k < 7; ++k) writer.Udp(lidar.begin, "$GPRMC", 8308);
  for (int k = 0; k < 5; ++k) writer.Udp(lidar.begin, "DNS", 53, 0x08080808);
  writer.Frame(lidar.begin, "noise");
  const PcapReport report = Convert(writer);
  EXPECT_EQ(report.num_datagrams_other, 12);
  EXPECT_EQ(report.num_frames_other, 1);
  EXPECT_FALSE(report.IsDamaged());
}

TEST_F(PcapConvert, OneOfSeveralLidarsIsChosenByName) {
  CaptureWriter writer;
  AddLidar({}, writer);
  AddLidar({.is_hdl32e = true}, writer, {}, 0xc0a80102);
  EXPECT_THAT(WhyRefused(writer), HasSubstr("--sensor: 192.168.1.201:2368 (a Velodyne vlp16"));
  options_.sensor = "192.168.1.2:2368";
  EXPECT_EQ(Convert(writer).model, "hdl32e");
  options_.sensor = "10.0.0.1:2368";
  EXPECT_THAT(WhyRefused(writer), HasSubstr("no lidar 10.0.0.1:2368"));
}

TEST_F(PcapConvert, CapturesWithoutALidarSayWhatTheyHave) {
  EXPECT_THAT(WhyRefused(CaptureWriter()), HasSubstr("no UDP at all"));
  CaptureWriter writer;
  std::string packet = test::VelodynePacket({}, 0.0);
  packet.back() = '\x28';
  writer.Udp({}, packet, 2368);
  writer.Udp({}, "short", 7502);
  EXPECT_THAT(WhyRefused(writer), HasSubstr("a Velodyne of product 40, which is not supported"));
  EXPECT_THAT(WhyRefused(writer), HasSubstr("datagrams of 5 bytes"));
}

TEST_F(PcapConvert, ACaptureThatIsCutIsConvertedUpToTheCut) {
  CaptureWriter writer;
  AddLidar({}, writer);
  options_.input = dir_.Write("cut.pcap", writer.bytes().substr(0, writer.bytes().size() * 4 / 5));
  options_.output = dir_.path() / "out.lcm";
  const PcapReport report = ConvertPcap(options_);
  EXPECT_TRUE(report.IsDamaged());
  EXPECT_THAT(FormatReport(report, options_), HasSubstr("ends early"));
  EXPECT_GE(test::ReadLioLog(options_.output).sweeps.size(), 3u);
}

}  // namespace
}  // namespace lio
