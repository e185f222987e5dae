// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "convert/livox_message.hpp"

#include <gmock/gmock.h>

#include "convert/recorded_bag.hpp"
#include "lio/convert/pointcloud2_layout.hpp"

namespace lio {
namespace {

using test::RosBytes;
using test::RosForm;

constexpr Timestamp kLivoxStamp = test::kRecordingBegin;

struct LivoxPoint {
  std::uint32_t offset_ns = 0;
  float x_m = 0, y_m = 0, z_m = 0;
  std::uint8_t reflectivity = 0, tag = 0, line = 0;
};

// Returns a petal of a rosette: four lines that look ahead, every fifth point without a return.
std::vector<LivoxPoint> Petal(int num) {
  std::vector<LivoxPoint> points;
  for (int i = 0; i < num; ++i) {
    const auto k = static_cast<float>(i);
    LivoxPoint point{static_cast<std::uint32_t>(i) * 10'000u,
                     10.0f + std::sin(k),
                     k / 500.0f,
                     0.5f,
                     static_cast<std::uint8_t>(i % 200),
                     0,
                     static_cast<std::uint8_t>(i % 4)};
    point.z_m = 0.2f * static_cast<float>(point.line);
    if (i % 5 == 4) point.x_m = point.y_m = point.z_m = 0.0f;
    points.push_back(point);
  }
  return points;
}

std::vector<std::uint8_t> LivoxBytes(Timestamp stamp, const std::vector<LivoxPoint>& points,
                                     RosBytes bytes) {
  bytes.PutHeader(stamp, "livox_frame");
  bytes.Put(static_cast<std::uint64_t>(stamp.ns));
  bytes.Put(static_cast<std::uint32_t>(points.size()));
  for (int i = 0; i < 4; ++i) bytes.Put(std::uint8_t{0});
  bytes.Put(static_cast<std::uint32_t>(points.size()));
  for (const LivoxPoint& point : points) {
    bytes.Put(point.offset_ns).Put(point.x_m).Put(point.y_m).Put(point.z_m);
    bytes.Put(point.reflectivity).Put(point.tag).Put(point.line);
  }
  return bytes.bytes();
}

class LivoxMessage : public testing::TestWithParam<RosForm> {
 protected:
  std::vector<std::uint8_t> Encode(const std::vector<LivoxPoint>& points) const {
    return LivoxBytes(kLivoxStamp, points, RosBytes(GetParam().encoding, GetParam().big_endian));
  }
};

TEST_P(LivoxMessage, APointKeepsPlaceTimeLineAndReflectivity) {
  const std::vector<LivoxPoint> points = Petal(50);
  const auto message = Encode(points);
  const auto cloud = DecodeLivox(message, GetParam().encoding);
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->stamp, kLivoxStamp);
  CloudPoints read;
  ReadPoints(*cloud, *FindLayout(cloud->fields), read);
  EXPECT_EQ(read.num_zero, 10);
  ASSERT_EQ(read.size(), 40u);
  EXPECT_EQ(read.x_m[39], points[48].x_m);
  EXPECT_EQ(read.z_m[39], points[48].z_m);
  EXPECT_EQ(read.time[39], points[48].offset_ns);
  EXPECT_EQ(read.ring[39], points[48].line);
  EXPECT_EQ(read.intensity[39], points[48].reflectivity);
}

TEST_P(LivoxMessage, EveryTruncationAndSurplusIsRefused) {
  std::vector<std::uint8_t> message = Encode(Petal(5));
  for (std::size_t size = 0; size < message.size(); ++size) {
    EXPECT_FALSE(DecodeLivox(ByteView(message).first(size), GetParam().encoding)) << size;
  }
  message.resize(message.size() + 8);
  EXPECT_FALSE(DecodeLivox(message, GetParam().encoding));
}

TEST_P(LivoxMessage, AnEmptyScanHasNoPoints) {
  const auto message = Encode({});
  const auto cloud = DecodeLivox(message, GetParam().encoding);
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->num_points(), 0u);
}

TEST_P(LivoxMessage, PointsThatTheFirstDriverTagsAsNoiseAreLeftOut) {
  std::vector<LivoxPoint> points = Petal(4);
  points[0].tag = 0x01;  // noise by place
  points[1].tag = 0x14;  // noise by intensity, second return
  points[2].tag = 0x12;  // perhaps noise
  const auto message = Encode(points);
  BagTopic topic{"/livox/lidar", "livox_ros_driver/CustomMsg", "", GetParam().encoding, 0};
  CloudPoints read;
  auto cloud = DecodeScan(topic, message);
  ASSERT_TRUE(cloud);
  ReadPoints(*cloud, *FindLayout(cloud->fields), read);
  EXPECT_EQ(read.num_noise, 2);
  EXPECT_EQ(read.size(), 2u);
  topic.type = "livox_ros_driver2/CustomMsg";  // its lidars mean other things by the same bits
  cloud = DecodeScan(topic, message);
  ReadPoints(*cloud, *FindLayout(cloud->fields), read);
  EXPECT_EQ(read.size(), 4u);
}

INSTANTIATE_TEST_SUITE_P(Forms, LivoxMessage,
                         testing::Values(RosForm{RosEncoding::kRos1, false},
                                         RosForm{RosEncoding::kCdr, false},
                                         RosForm{RosEncoding::kCdr, true}),
                         [](const auto& tested) {
                           return std::string(tested.param.encoding == RosEncoding::kRos1 ? "Ros1"
                                              : tested.param.big_endian ? "CdrBigEndian"
                                                                        : "CdrLittleEndian");
                         });

using LivoxConversion = test::RosbagConversion;

TEST_F(LivoxConversion, ScansBecomeSweepsWithTheTimesOfTheirPoints) {
  test::Bag2Writer writer(dir_.path() / "drive");
  const std::vector<LivoxPoint> points = Petal(9'999);
  constexpr int kNumScans = 20;
  for (int k = 0; k < kNumScans; ++k) {
    const Timestamp stamp = kLivoxStamp + Duration{100'000'000LL * k};
    writer.Write("/livox/lidar", "livox_ros_driver2/msg/CustomMsg", stamp + Duration{101'000'000},
                 LivoxBytes(stamp, points, RosBytes(RosEncoding::kCdr)));
    writer.Write("/livox/imu", "sensor_msgs/msg/Imu", stamp,
                 test::ImuMessage({stamp, {}, {0, 0, 1}}, RosBytes(RosEncoding::kCdr)));
  }
  writer.Close();
  options_.input = dir_.path() / "drive";
  const RosbagReport report = Convert();
  EXPECT_FALSE(report.IsDamaged());
  EXPECT_THAT(report.rules.stamp_text, testing::HasSubstr("sweep start"));
  const test::LioLog log = Log();
  ASSERT_EQ(log.sweeps.size(), static_cast<std::size_t>(kNumScans));
  const auto& sweep = log.sweeps[7].points;
  ASSERT_EQ(sweep.size(), 8'000u);
  for (std::size_t i = 0; i < sweep.size(); i += 997) {
    const LivoxPoint& point = points[i / 4 * 5 + i % 4];
    EXPECT_EQ(sweep[i].instant_ns, kLivoxStamp.ns + 700'000'000 + point.offset_ns);
    EXPECT_EQ(sweep[i].point.x_m, point.x_m);
    EXPECT_EQ(sweep[i].point.ring, point.line);
  }
}

}  // namespace
}  // namespace lio
