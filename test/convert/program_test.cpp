// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tests lio-convert as its users see it: exit codes, one-line messages, help.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/build_paths.hpp"
#include "support/mcap_writer.hpp"
#include "support/run_program.hpp"
#include "support/spinning_lidar.hpp"

namespace lio {
namespace {

using test::ProgramResult;
using testing::HasSubstr;

constexpr Timestamp kLogBegin{1'500'000'000'000'000'000};

class ConvertProgram : public testing::Test {
 protected:
  ProgramResult Run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), test::Program("lio-convert"));
    return test::RunProgram(arguments);
  }
  // Expects one line on stderr that begins with the program's name.
  static void ExpectOneLine(const ProgramResult& result, int exit_code) {
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_TRUE(result.err.starts_with("lio-convert: ")) << result.err;
  }
  std::string Path(const std::string& name) const { return (dir_.path() / name).string(); }

  // Writes a bag of `num` clouds on each of the topics, and an IMU.
  // Writes "drive.mcap" with the messages of the bag.
  std::string WriteMcap(int num, const std::string& compression) {
    test::CopyToMcap(WriteBag({"/points"}, num), dir_.path() / "drive.mcap",
                     {.compression = compression}, [](const BagTopic&, const BagMessage& message) {
                       return std::vector<std::uint8_t>(message.data.begin(), message.data.end());
                     });
    return Path("drive.mcap");
  }
  std::string WriteBag(const std::vector<std::string>& cloud_topics, int num = 12,
                       const test::Bag1Writer::Options& form = {}) {
    test::Bag1Writer writer(dir_.path() / "drive.bag", form);
    const test::SpinningLidar lidar;
    for (int k = 0; k < num; ++k) {
      const Timestamp stamp = kLogBegin + Duration::FromSeconds(k * CloudSeconds(lidar));
      const Timestamp received = stamp + Duration::FromSeconds(CloudSeconds(lidar) + 0.005);
      writer.Write("/imu", "sensor_msgs/Imu", received,
                   test::ImuMessage({stamp, {0, 0, 0}, {0, 0, 9.81}}));
      for (const std::string& topic : cloud_topics) {
        writer.Write(topic, "sensor_msgs/PointCloud2", received,
                     test::CloudMessage(test::VelodyneCloud(stamp, test::SeePoints(lidar, k))));
      }
    }
    writer.Close();
    return Path("drive.bag");
  }

  test::TempDir dir_;
};

TEST_F(ConvertProgram, HelpTeachesWithExamples) {
  const ProgramResult help = Run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, HasSubstr("lio-convert rosbag drive.bag drive.lcm"));
  EXPECT_EQ(Run({"rosbag", "--help"}).exit_code, 0);
  EXPECT_EQ(Run({"kitti-raw", "--help"}).exit_code, 0);
  EXPECT_EQ(Run({"kitti-odometry", "--help"}).exit_code, 0);
}

TEST_F(ConvertProgram, VersionIsPrinted) {
  const ProgramResult version = Run({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, HasSubstr("lio-convert 0."));
}

TEST_F(ConvertProgram, ConvertsAndSummarises) {
  const ProgramResult result = Run({"rosbag", WriteBag({"/points"}), Path("out.lcm")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("/points: 12 sweeps"));
  EXPECT_THAT(result.out, HasSubstr("/imu: 12 samples"));
  EXPECT_THAT(result.out, HasSubstr("field 'time' in s from the stamp"));
  EXPECT_THAT(result.out, HasSubstr("stamp        sweep start"));
  EXPECT_THAT(result.out, HasSubstr("gravity present"));
}

TEST_F(ConvertProgram, TakesOptionsBeforeAndAfterPositionals) {
  const std::string bag = WriteBag({"/points"});
  EXPECT_EQ(Run({"rosbag", "--whole-scans", bag, Path("a.lcm")}).exit_code, 0);
  EXPECT_EQ(Run({"rosbag", bag, Path("b.lcm"), "--whole-scans"}).exit_code, 0);
  EXPECT_EQ(test::ReadText(dir_.path() / "a.lcm"), test::ReadText(dir_.path() / "b.lcm"));
}

TEST_F(ConvertProgram, WrongUsageIs2) {
  ExpectOneLine(Run({}), 2);
  ExpectOneLine(Run({"frobnicate"}), 2);
  ExpectOneLine(Run({"rosbag"}), 2);
  ExpectOneLine(Run({"rosbag", "in.bag", "out.lcm", "--stamp", "middle"}), 2);
  ExpectOneLine(Run({"rosbag", "in.bag", "out.lcm", "--point-time", "h"}), 2);
  ExpectOneLine(Run({"rosbag", "in.bag", "out.lcm", "--start", "-1"}), 2);
  ExpectOneLine(Run({"rosbag", "in.bag", "out.lcm", "--duration", "0"}), 2);
  ExpectOneLine(Run({"rosbag", "in.bag", "out.lcm", "--start", "nan"}), 2);
  ExpectOneLine(Run({"rosbag", "in.bag", "out.lcm", "--duration", "inf"}), 2);
  ExpectOneLine(Run({"rosbag", "in.bag", "out.lcm", "--no-such-option"}), 2);
  ExpectOneLine(Run({"rosbag", "in.bag", "out.lcm", "--truth-topic", "/t"}), 2);
  ExpectOneLine(Run({"kitti-raw", "dir", "out.lcm", "--imu-rate", "-5"}), 2);
  ExpectOneLine(Run({"kitti-odometry", "dir", "out.lcm", "--vertical-correction", "x"}), 2);
}

TEST_F(ConvertProgram, AnAmbiguousTopicIs2AndListsThem) {
  const std::string bag = WriteBag({"/left", "/right"});
  const ProgramResult result = Run({"rosbag", bag, Path("out.lcm")});
  ExpectOneLine(result, 2);
  EXPECT_THAT(result.err, HasSubstr("--lidar-topic"));
  EXPECT_THAT(result.err, HasSubstr("/left"));
  EXPECT_THAT(result.err, HasSubstr("/right"));
  EXPECT_EQ(Run({"rosbag", bag, Path("out.lcm"), "--lidar-topic", "/left"}).exit_code, 0);
}

TEST_F(ConvertProgram, AWrongTopicOrModelIs2) {
  const std::string bag = WriteBag({"/points"});
  ExpectOneLine(Run({"rosbag", bag, Path("o.lcm"), "--lidar-topic", "/nope"}), 2);
  ExpectOneLine(Run({"rosbag", bag, Path("o.lcm"), "--lidar-topic", "/imu"}), 2);
  const ProgramResult model = Run({"rosbag", bag, Path("o.lcm"), "--lidar", "hdl33"});
  ExpectOneLine(model, 2);
  EXPECT_THAT(model.err, HasSubstr("hdl32e"));
}

TEST_F(ConvertProgram, MissingOrUnusableInputIs5) {
  ExpectOneLine(Run({"rosbag", Path("no.bag"), Path("o.lcm")}), 5);
  ExpectOneLine(Run({"rosbag", dir_.Write("text.bag", "hello").string(), Path("o.lcm")}), 5);
  ExpectOneLine(Run({"kitti-raw", Path("no"), Path("o.lcm")}), 5);
  ExpectOneLine(Run({"kitti-raw", dir_.path().string(), Path("o.lcm")}), 5);
  ExpectOneLine(Run({"kitti-odometry", Path("no"), Path("o.lcm")}), 5);
  const std::string bag = WriteBag({});
  const ProgramResult no_lidar = Run({"rosbag", bag, Path("o.lcm")});
  ExpectOneLine(no_lidar, 5);
  EXPECT_THAT(no_lidar.err, HasSubstr("no sensor_msgs/PointCloud2"));
  EXPECT_THAT(no_lidar.err, HasSubstr("/imu (sensor_msgs/Imu)"));
}

TEST_F(ConvertProgram, AWrongUnitIsRefused) {
  const std::string bag = WriteBag({"/points"});
  const ProgramResult result = Run({"rosbag", bag, Path("o.lcm"), "--point-time", "us"});
  ExpectOneLine(result, 5);
  EXPECT_THAT(result.err, HasSubstr("5 to 500 ms"));
}

TEST_F(ConvertProgram, DamagedLivoxMessagesAreRefused) {
  test::Bag1Writer writer(dir_.path() / "livox.bag");
  writer.Write("/livox/lidar", "livox_ros_driver/CustomMsg", kLogBegin, {1, 2, 3});
  writer.Close();
  const ProgramResult result = Run({"rosbag", Path("livox.bag"), Path("o.lcm")});
  ExpectOneLine(result, 5);
  EXPECT_THAT(result.err, HasSubstr("/livox/lidar: no cloud with returns can be read"));
}

TEST_F(ConvertProgram, ACutBagIsConvertedUpToTheCutAndIs5) {
  const std::string bytes = test::ReadText(WriteBag({"/points"}, 20));
  dir_.Write("cut.bag", bytes.substr(0, bytes.size() / 2));
  const ProgramResult result = Run({"rosbag", Path("cut.bag"), Path("o.lcm")});
  ExpectOneLine(result, 5);
  EXPECT_THAT(result.out, HasSubstr("bytes lost"));
  EXPECT_THAT(result.out, HasSubstr("converted up to"));
  EXPECT_GT(std::filesystem::file_size(dir_.path() / "o.lcm"), 100'000u);
}

TEST_F(ConvertProgram, ABagThatIsCutBeforeItsFirstScanSaysHowMuchIsLost) {
  const std::string bytes = test::ReadText(WriteBag({"/points"}, 20));
  dir_.Write("cut.bag", bytes.substr(0, 5000));
  const ProgramResult result = Run({"rosbag", Path("cut.bag"), Path("o.lcm")});
  ExpectOneLine(result, 5);
  EXPECT_THAT(result.err, HasSubstr("cut.bag: damaged before its first scan, "));
  EXPECT_THAT(result.err, HasSubstr("bytes lost; first: "));
}

TEST_F(ConvertProgram, ABagThatWasNeverClosedIsConvertedAndIs5) {
  const std::string bag = WriteBag({"/points"}, 20, {.with_index = false});
  const ProgramResult result = Run({"rosbag", bag, Path("o.lcm")});
  ExpectOneLine(result, 5);
  EXPECT_THAT(result.out, HasSubstr("was never closed, it has no index"));
  EXPECT_THAT(result.out, HasSubstr("/points: 20 sweeps"));
}

TEST_F(ConvertProgram, ADamagedMessageInASoundBagIsPassedOverAndIs5) {
  const test::SpinningLidar lidar;
  test::Bag1Writer writer(dir_.path() / "drive.bag");
  for (int k = 0; k < 12; ++k) {
    const Timestamp stamp = kLogBegin + Duration::FromSeconds(k * CloudSeconds(lidar));
    auto cloud = test::CloudMessage(test::VelodyneCloud(stamp, test::SeePoints(lidar, k)));
    if (k == 5) cloud.resize(cloud.size() / 2);
    writer.Write("/points", "sensor_msgs/PointCloud2",
                 stamp + Duration::FromSeconds(CloudSeconds(lidar) + 0.005), cloud);
  }
  writer.Close();
  const ProgramResult result = Run({"rosbag", Path("drive.bag"), Path("o.lcm")});
  ExpectOneLine(result, 5);
  EXPECT_THAT(result.out, HasSubstr("/points: 11 sweeps"));
  EXPECT_THAT(result.out, HasSubstr("1 messages skipped, /points"));
}

TEST_F(ConvertProgram, ACutRos2BagIsConvertedUpToTheCutAndIs5) {
  const test::SpinningLidar lidar;
  test::Bag2Writer writer(dir_.path() / "drive");
  for (int k = 0; k < 20; ++k) {
    const Timestamp stamp = kLogBegin + Duration::FromSeconds(k * CloudSeconds(lidar));
    writer.Write("/points", "sensor_msgs/msg/PointCloud2",
                 stamp + Duration::FromSeconds(CloudSeconds(lidar) + 0.005),
                 test::CloudMessage(test::VelodyneCloud(stamp, test::SeePoints(lidar, k)),
                                    test::RosBytes(RosEncoding::kCdr)));
  }
  writer.Close();
  const ProgramResult whole = Run({"rosbag", Path("drive"), Path("o.lcm")});
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_THAT(whole.out, HasSubstr("/points: 20 sweeps"));
  const std::string bytes = test::ReadText(dir_.path() / "drive/bag_0.db3");
  dir_.Write("drive/bag_0.db3", bytes.substr(0, bytes.size() / 2));
  const ProgramResult cut = Run({"rosbag", Path("drive"), Path("o.lcm")});
  ExpectOneLine(cut, 5);
  EXPECT_THAT(cut.out, HasSubstr("messages missing"));
  EXPECT_THAT(cut.out, HasSubstr("converted up to"));
}

TEST_F(ConvertProgram, ACutMcapIsConvertedUpToTheCutAndIs5) {
  const ProgramResult whole = Run({"rosbag", WriteMcap(12, "lz4"), Path("o.lcm")});
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  const std::string bytes = test::ReadText(dir_.path() / "drive.mcap");
  dir_.Write("drive.mcap", bytes.substr(0, bytes.size() / 2));
  const ProgramResult cut = Run({"rosbag", Path("drive.mcap"), Path("o.lcm")});
  ExpectOneLine(cut, 5);
  EXPECT_THAT(cut.out, HasSubstr("the bag is cut short"));
  EXPECT_THAT(cut.out, HasSubstr("converted up to"));
}

// A bag of four times the length must take the same memory to a few megabytes.
TEST_F(ConvertProgram, MemoryDoesNotGrowWithTheBag) {
  const auto peak_kb = [&](int num_clouds) {
    const std::string bag = WriteBag({"/points"}, num_clouds, {.compression = "lz4"});
    return test::PeakMemoryKb({test::Program("lio-convert"), "rosbag", bag, Path("o.lcm")});
  };
  const std::int64_t of_short = peak_kb(100);
  const std::int64_t of_long = peak_kb(400);
  EXPECT_GT(of_short, 0);
  EXPECT_GT(std::filesystem::file_size(dir_.path() / "o.lcm"), 40'000'000u);
  EXPECT_LT(of_long, of_short + 5'000);
}

TEST_F(ConvertProgram, MemoryDoesNotGrowWithAnMcapFile) {
  const auto peak_kb = [&](int num_clouds) {
    const std::string mcap = WriteMcap(num_clouds, "zstd");
    return test::PeakMemoryKb({test::Program("lio-convert"), "rosbag", mcap, Path("o.lcm")});
  };
  const std::int64_t of_short = peak_kb(100);
  EXPECT_GT(of_short, 0);
  EXPECT_LT(peak_kb(400), of_short + 5'000);
}

TEST_F(ConvertProgram, AnOutputThatCannotBeWrittenIsOneLine) {
  const ProgramResult result = Run({"rosbag", WriteBag({"/points"}), Path("no/such/folder/o.lcm")});
  ExpectOneLine(result, 2);
  EXPECT_THAT(result.err, HasSubstr("cannot create"));
  const ProgramResult full = Run({"rosbag", WriteBag({"/points"}), "/dev/full"});
  ExpectOneLine(full, 74);
  EXPECT_THAT(full.err, HasSubstr("No space left"));
  ExpectOneLine(Run({"rosbag", WriteBag({"/points"}), dir_.path().string()}), 2);
}

TEST_F(ConvertProgram, TheRecordingIsNeverOverwritten) {
  const std::string bag = WriteBag({"/points"});
  const std::string before = test::ReadText(bag);
  const ProgramResult result = Run({"rosbag", bag, bag});
  ExpectOneLine(result, 2);
  EXPECT_THAT(result.err, HasSubstr("name another file"));
  EXPECT_TRUE(test::ReadText(bag) == before);
}

}  // namespace
}  // namespace lio
