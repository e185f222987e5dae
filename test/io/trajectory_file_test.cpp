// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/trajectory_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "lio/base/stamp_limit.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using ::testing::EndsWith;

class TrajectoryFile : public ::testing::Test {
 protected:
  Trajectory Read(const std::string& text) { return ReadTrajectory(dir_.Write("t.txt", text)); }

  // Returns the message without the file's name.
  std::string Fault(const std::string& text) {
    try {
      Read(text);
    } catch (const std::runtime_error& e) {
      return std::string(e.what()).substr((dir_.path() / "t.txt").string().size());
    }
    return "no fault";
  }

  test::TempDir dir_;
};

TEST_F(TrajectoryFile, TumRowsAreReadWithCommentsAndBlankLines) {
  const Trajectory trajectory = Read(
      "# t x y z qx qy qz qw\n"
      "\n"
      "1700000000.123456789 1 2 3 0 0 0 1\r\n"
      " 1700000001.5\t-1 +2e0 3.5   0.7071 0 0 0.7071\n");
  EXPECT_EQ(trajectory.format, TrajectoryFormat::kTum);
  ASSERT_EQ(trajectory.poses.size(), 2u);
  EXPECT_EQ(trajectory.poses[0].stamp.ns, 1'700'000'000'123'456'789);
  EXPECT_EQ(trajectory.poses[0].pose.translation, Vector3(1, 2, 3));
  EXPECT_EQ(trajectory.poses[1].pose.translation, Vector3(-1, 2, 3.5));
  EXPECT_NEAR(trajectory.poses[1].pose.rotation.x(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(trajectory.poses[1].pose.rotation.norm(), 1.0, 1e-15);
}

TEST_F(TrajectoryFile, KittiRowsAreReadByIndex) {
  const Trajectory trajectory = Read(
      "1 0 0 10 0 1 0 20 0 0 1 30\n"
      "0 -1 0 1 1 0 0 2 0 0 1 3\n");
  EXPECT_EQ(trajectory.format, TrajectoryFormat::kKitti);
  ASSERT_EQ(trajectory.poses.size(), 2u);
  EXPECT_EQ(trajectory.poses[1].stamp.ns, 1);
  EXPECT_EQ(trajectory.poses[0].pose.translation, Vector3(10, 20, 30));
  EXPECT_LT((trajectory.poses[1].pose.rotation * Vector3::UnitX() - Vector3::UnitY()).norm(),
            1e-12);
}

TEST_F(TrajectoryFile, FaultsNameLineAndColumn) {
  const std::string good = "1 0 0 0 0 0 0 1\n";
  EXPECT_EQ(Fault(good + "2 0 nan 0 0 0 0 1\n"), ":2: column 3 ('nan') is no finite number");
  EXPECT_EQ(Fault(good + "2 0 0 inf 0 0 0 1\n"), ":2: column 4 ('inf') is no finite number");
  EXPECT_EQ(Fault(good + "2 0 0 0 0 0 0 1x\n"), ":2: column 8 ('1x') is no finite number");
  EXPECT_EQ(Fault(good + "nan 0 0 0 0 0 0 1\n"), ":2: column 1 ('nan') is no stamp in seconds");
  EXPECT_EQ(Fault(good + "\n" + good),
            ":3: column 1 ('1') is not above the stamp of the row before");
  EXPECT_EQ(Fault(good + "0.5 0 0 0 0 0 0 1\n"),
            ":2: column 1 ('0.5') is not above the stamp of the row before");
  EXPECT_EQ(Fault(good + "2 0 0 0 0 0 1\n"), ":2: has 7 columns, the rows before have 8");
  EXPECT_EQ(Fault("1 2 3\n"), ":1: has 3 columns; TUM has 8 (t x y z qx qy qz qw), KITTI 12");
  EXPECT_EQ(Fault("1 0 0 0 0 0 0 0\n"), ":1: columns 5 to 8 are no rotation: their norm is 0");
  EXPECT_EQ(Fault("1 0 0 0 0 1 0 0 0 0 -1 0\n"),
            ":1: columns 1-3, 5-7 and 9-11 are no rotation matrix");
  EXPECT_EQ(Fault("# nothing\n"), ": holds no pose");
}

TEST_F(TrajectoryFile, PositionsBeyondReasonAreRefused) {
  EXPECT_EQ(Fault("1 1e12 0 0 0 0 0 1\n"), "no fault");
  EXPECT_EQ(Fault("1 1e300 0 0 0 0 0 1\n"), ":1: column 2 ('1e300') is beyond 1e12 m");
  EXPECT_EQ(Fault("1 0 0 1 0 1 0 -1e13 0 0 1 0\n"), ":1: column 8 ('-1e13') is beyond 1e12 m");
}

TEST_F(TrajectoryFile, MissingFilesAreNamed) {
  EXPECT_THROW(static_cast<void>(ReadTrajectory(dir_.path() / "missing.tum")), std::runtime_error);
  EXPECT_THROW(static_cast<void>(ReadTrajectory(dir_.path())), std::runtime_error);
  EXPECT_THROW(WriteTum(dir_.path() / "no" / "such.tum", {}), std::runtime_error);
}

TEST_F(TrajectoryFile, WrittenFilesReadBackTheSame) {
  const StampedPoses poses = {{Timestamp{1'700'000'000'000'000'001}, Pose::Identity()},
                              {Timestamp{1'700'000'000'100'000'000},
                               {ExpSo3({0.1, -0.2, 0.3}), {1234.567890123, -2, 1e-9}}}};
  const auto file = dir_.path() / "out.txt";
  WriteTum(file, poses);
  const Trajectory tum = ReadTrajectory(file);
  WriteKitti(file, poses);
  const Trajectory kitti = ReadTrajectory(file);
  for (const Trajectory* read : {&tum, &kitti}) {
    ASSERT_EQ(read->poses.size(), 2u);
    EXPECT_LT((read->poses[1].pose.translation - poses[1].pose.translation).norm(), 1e-8);
    EXPECT_LT(read->poses[1].pose.rotation.angularDistance(poses[1].pose.rotation), 1e-8);
  }
  EXPECT_EQ(tum.poses[0].stamp, poses[0].stamp);
  EXPECT_EQ(tum.poses[1].stamp, poses[1].stamp);
}

TEST_F(TrajectoryFile, TumRowHasNineDecimals) {
  EXPECT_EQ(TumRow({Timestamp{1'500'000'000}, Pose::Identity()}),
            "1.500000000 0.000000000 0.000000000 0.000000000 0.000000000 0.000000000 0.000000000 "
            "1.000000000");
}

TEST_F(TrajectoryFile, ALastRowThatIsCutIsLeftOut) {
  for (const char* cut : {"2", "2 1 2 3 0 0", "2 1 2 3 0 0 0 -", "2 1 2 3 0 0 0 0."}) {
    const Trajectory read =
        ReadTrajectory(dir_.Write("cut.tum", std::string("1 0 0 0 0 0 0 1\n") + cut));
    EXPECT_EQ(read.poses.size(), 1u) << cut;
  }
  EXPECT_EQ(
      ReadTrajectory(dir_.Write("whole.tum", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1")).poses.size(), 2u);
  EXPECT_THROW((void)ReadTrajectory(dir_.Write("only.tum", "1 0 0")), std::runtime_error);
}

TEST(Stamp, TextIsExactAndReadsBack) {
  for (const std::int64_t ns :
       {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1}, std::int64_t{1'700'000'000'123'456'789},
        std::int64_t{-2'000'000'001}, kMaxStamp_ns, -kMaxStamp_ns}) {
    const std::optional<Timestamp> stamp = ParseStamp(StampText(Timestamp{ns}));
    ASSERT_TRUE(stamp.has_value()) << ns;
    EXPECT_EQ(stamp->ns, ns);
  }
  EXPECT_EQ(StampText(Timestamp{-2'000'000'001}), "-2.000000001");
}

TEST(Stamp, EveryDecimalFormIsRead) {
  EXPECT_EQ(ParseStamp("5")->ns, 5'000'000'000);
  EXPECT_EQ(ParseStamp(".25")->ns, 250'000'000);
  EXPECT_EQ(ParseStamp("+1.")->ns, 1'000'000'000);
  EXPECT_EQ(ParseStamp("1.4036365797635555270e+09")->ns, 1'403'636'579'763'555'527);
  EXPECT_EQ(ParseStamp("2.5e-9")->ns, 3);  // half away from zero
  EXPECT_EQ(ParseStamp("-2.5E-9")->ns, -3);
  EXPECT_EQ(ParseStamp("4e-10")->ns, 0);
  EXPECT_EQ(ParseStamp("0.9999999999")->ns, 1'000'000'000);
  EXPECT_EQ(ParseStamp("1e-30")->ns, 0);
}

TEST(Stamp, AnythingElseIsRefused) {
  for (const char* text :
       {"", ".", "-", "1.2.3", "1e", "e5", "0x10", "1 ", "inf", "nan", "1e99", "9223372037",
        "4611686018.5", "-4611686018.5", "1e2.5", "--1", "1e99999999999"}) {
    EXPECT_FALSE(ParseStamp(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace lio
