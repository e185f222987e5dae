// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/file_kind.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_dir.hpp"

namespace lio {
namespace {

using namespace std::string_literals;
using ::testing::HasSubstr;

class FileKindTest : public ::testing::Test {
 protected:
  std::filesystem::path Make(const std::string& name, const std::string& content) const {
    return folder_.Write(name, content);
  }

  test::TempDir folder_;
};

TEST_F(FileKindTest, ContentTellsTheKindAndNotTheName) {
  EXPECT_EQ(KindOf(Make("a.bag", "\xED\xA1\xDA\x01\0\0"s)), FileKind::kLcmLog);
  EXPECT_EQ(KindOf(Make("b.lcm", "#ROSBAG V2.0\n")), FileKind::kRosBag);
  EXPECT_EQ(KindOf(Make("c.lcm", "SQLite format 3\0"s)), FileKind::kRosBag);
  EXPECT_EQ(KindOf(Make("d.lcm", "\x89MCAP0\r\n")), FileKind::kRosBag);
  EXPECT_EQ(KindOf(Make("e.lcm", "x")), FileKind::kOther);
  EXPECT_EQ(KindOf(folder_.path() / "not there"), FileKind::kOther);
}

TEST_F(FileKindTest, FoldersAreToldByWhatIsInThem) {
  EXPECT_EQ(KindOf(Make("run/trajectory.tum", "").parent_path()), FileKind::kRunFolder);
  EXPECT_EQ(KindOf(Make("ros2/x.db3", "").parent_path()), FileKind::kRosBag);
  EXPECT_EQ(KindOf(Make("mcap/x_0.mcap", "").parent_path()), FileKind::kRosBag);
  EXPECT_EQ(KindOf(Make("split/x_0.bag", "").parent_path()), FileKind::kRosBag);
  EXPECT_EQ(KindOf(Make("kitti/velodyne_points/data", "").parent_path().parent_path()),
            FileKind::kKittiRaw);
  Make("05/times.txt", "");
  EXPECT_EQ(KindOf(Make("05/velodyne/000000.bin", "").parent_path().parent_path()),
            FileKind::kKittiOdometry);
  Make("sim/log.lcm", "");
  const auto sim = Make("sim/config.yaml", "").parent_path();
  EXPECT_EQ(KindOf(sim), FileKind::kLogFolder);
  EXPECT_THAT(WhyNoLog(sim), HasSubstr((sim / "log.lcm").string()));
}

TEST_F(FileKindTest, EachProgramNamesTheRightCommand) {
  const auto bag = Make("a.bag", "#ROSBAG V2.0\n");
  const auto log = Make("a.lcm", "\xED\xA1\xDA\x01");
  const auto run = Make("run/trajectory_level.tum", "").parent_path();
  Make("run/trajectory.tum", "");
  EXPECT_THAT(WhyNoLog(bag), HasSubstr("lio-convert rosbag " + bag.string()));
  EXPECT_EQ(WhyNoLog(log), "");
  EXPECT_THAT(WhyNoTrajectory(run), HasSubstr((run / "trajectory_level.tum").string()));
  EXPECT_THAT(WhyNoTrajectory(log), HasSubstr("lio-replay"));
  EXPECT_THAT(WhyNoRecording(log), HasSubstr("lio-replay"));
  EXPECT_EQ(WhyNoRecording(bag), "");
}

}  // namespace
}  // namespace lio
