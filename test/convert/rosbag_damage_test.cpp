// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests the conversion of damaged bags and of bags with damaged messages.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "convert/recorded_bag.hpp"
#include "lio/convert/rosbag_convert.hpp"
#include "lio/io/input_error.hpp"

namespace lio {
namespace {

using test::Drivers;
using test::kRecordingBegin;
using test::RosbagConversion;
using test::TestCloud;

// Writes bags in which every tenth message is damaged by `spoil`.
class SpoiltBag : public RosbagConversion {
 protected:
  RosbagReport ConvertSpoilt(
      const std::string& type_to_spoil,
      const std::function<std::vector<std::uint8_t>(std::vector<std::uint8_t>)>& spoil) {
    test::Bag1Writer writer(dir_.path() / "drive.bag");
    int num = 0;
    Record(
        Drivers()[0],
        [&](auto& topic, auto& type, Timestamp received, auto& data) {
          const bool hit = type == type_to_spoil && ++num % 10 == 0;
          writer.Write(topic, test::FullType(type, "/"), received, hit ? spoil(data) : data);
        },
        test::RosBytes());
    writer.Close();
    options_.input = dir_.path() / "drive.bag";
    return Convert();
  }
};

TEST_F(SpoiltBag, ShortCloudsArePassedOverAndCounted) {
  const RosbagReport report = ConvertSpoilt("PointCloud2", [](auto data) {
    data.resize(data.size() - 100);
    return data;
  });
  EXPECT_TRUE(report.IsDamaged());
  ASSERT_EQ(report.num_damaged.size(), 1u);
  EXPECT_EQ(report.num_damaged.begin()->second, 3);
  EXPECT_EQ(Log().sweeps.size(), 27u);
  EXPECT_NE(FormatReport(report, options_).find("3 messages skipped, /points"), std::string::npos);
}

TEST_F(SpoiltBag, CloudsWithOtherFieldsArePassedOverAndCounted) {
  TestCloud other;
  other.fields = test::Fields({});
  other.point_step = 12;
  other.stamp = kRecordingBegin;
  other.Resize(10);
  other.Set(0, "x", 5.0);
  const RosbagReport report =
      ConvertSpoilt("PointCloud2", [&](auto) { return test::CloudMessage(other); });
  EXPECT_TRUE(report.IsDamaged());
  EXPECT_EQ(report.num_damaged.begin()->second, 3);
  EXPECT_EQ(Log().sweeps.size(), 27u);
}

TEST_F(SpoiltBag, CloudsWithImpossibleTimesArePassedOverAndCounted) {
  const test::SpinningLidar lidar;
  TestCloud wild = test::VelodyneCloud(kRecordingBegin, test::SeePoints(lidar, 0));
  wild.Set(100, "time", 77.0);
  const RosbagReport report =
      ConvertSpoilt("PointCloud2", [&](auto) { return test::CloudMessage(wild); });
  EXPECT_TRUE(report.IsDamaged());
  EXPECT_EQ(Log().sweeps.size(), 27u);
}

TEST_F(SpoiltBag, EmptyCloudsAreNoDamage) {
  TestCloud empty = test::VelodyneCloud(kRecordingBegin, {});
  const RosbagReport report =
      ConvertSpoilt("PointCloud2", [&](auto) { return test::CloudMessage(empty); });
  EXPECT_FALSE(report.IsDamaged());
  EXPECT_EQ(report.num_empty, 3);
}

TEST_F(SpoiltBag, LongImuMessagesArePassedOverAndCounted) {
  const RosbagReport report = ConvertSpoilt("Imu", [](auto data) {
    data.push_back(0);
    return data;
  });
  EXPECT_TRUE(report.IsDamaged());
  EXPECT_GT(report.num_damaged.begin()->second, 20);
  EXPECT_EQ(Log().sweeps.size(), 30u);
}

TEST_F(RosbagConversion, OfACutBagGoesUpToTheCut) {
  WriteBag1(Drivers()[0], {.compression = "lz4", .chunk_bytes = 200'000});
  const std::string whole = test::ReadText(options_.input);
  std::size_t num_before = 0;
  for (const double share : {0.3, 0.5, 0.7, 0.9}) {
    const auto size = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
    options_.input = dir_.Write("cut.bag", whole.substr(0, size));
    const RosbagReport report = Convert();
    EXPECT_TRUE(report.IsDamaged());
    EXPECT_TRUE(report.damage.cut_short);
    EXPECT_GT(report.damage.lost_bytes, 0);
    const std::size_t num = Log().sweeps.size();
    EXPECT_GT(num, num_before);
    EXPECT_LT(num, 30u);
    num_before = num;
  }
}

TEST_F(RosbagConversion, OfAnUnindexedBagIsWholeAndSaysSo) {
  WriteBag1(Drivers()[0], {.compression = "lz4", .chunk_bytes = 200'000, .with_index = false});
  const RosbagReport report = Convert();
  EXPECT_TRUE(report.IsDamaged());
  EXPECT_TRUE(report.damage.not_closed);
  EXPECT_EQ(Log().sweeps.size(), 30u);
}

TEST_F(RosbagConversion, SurvivesRandomMutations) {
  WriteBag1(Drivers()[0], {.compression = "none", .chunk_bytes = 50'000});
  const std::string whole = test::ReadText(options_.input);
  std::mt19937 random(8);
  for (int round = 0; round < 25; ++round) {
    std::string bytes = whole;
    for (int i = 0; i < 40; ++i) {
      bytes[4109 + random() % (bytes.size() - 4109)] = static_cast<char>(random());
    }
    options_.input = dir_.Write("mutated.bag", bytes);
    options_.output = dir_.path() / "out.lcm";
    try {
      const RosbagReport report = ConvertRosbag(options_);
      EXPECT_FALSE(FormatReport(report, options_).empty());
    } catch (const InputError&) {
    } catch (const UsageError&) {
    }
  }
}

}  // namespace
}  // namespace lio
