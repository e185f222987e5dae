// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/level_track.hpp"

#include <gtest/gtest.h>

#include "lio/io/trajectory_file.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

// The map is tilted by this against the world, as a start knows the vertical.
const Quaternion kMapTilt = ExpSo3(Vector3(0.02, -0.01, 0.0));

// The path has 100 m, level in world; in map it climbs.
FilterReport ReportAt(double x_m) {
  FilterReport report;
  report.nav.stamp = {1'700'000'000'000'000'000 + static_cast<std::int64_t>(x_m * 1e9)};
  report.nav.T_world_imu = {ExpSo3(Vector3(0.0, 0.0, 0.1)), Vector3(x_m, 0.3 * x_m, 0.0)};
  const Pose T_map_world{kMapTilt, Vector3::Zero()};
  report.nav.T_map_imu = T_map_world * report.nav.T_world_imu;
  report.nav.pose_cov = 0.04 * Matrix6::Identity();
  report.g_world_mps2 = Vector3(0, 0, -9.8);
  return report;
}

class LevelTrackTest : public ::testing::Test {
 protected:
  fs::path File(const char* name) const { return folder_.path() / name; }

  test::TempDir folder_;
};

TEST_F(LevelTrackTest, PathIsTurnedRigidlyUntilItIsLevel) {
  LevelTrack track(folder_.path());
  for (int x = 0; x <= 100; x += 10) track.Add(ReportAt(x), {});
  track.Finish();
  const StampedPoses poses = ReadTrajectory(File("trajectory_level.tum")).poses;
  ASSERT_EQ(poses.size(), 11u);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const FilterReport report = ReportAt(10.0 * static_cast<double>(i));
    EXPECT_EQ(poses[i].stamp, report.nav.stamp);
    EXPECT_NEAR(poses[i].pose.translation.z(), 0.0, 1e-8);
    EXPECT_NEAR(poses[i].pose.translation.norm(), report.nav.T_map_imu.translation.norm(), 1e-8);
    const Vector3 up = poses[i].pose.rotation * Vector3::UnitZ();
    EXPECT_NEAR(up.z(), 1.0, 1e-12);
  }
  // The vertical is known, north is not: the turn is the shortest one.
  EXPECT_NEAR(LogSo3(track.R_level_map()).norm(), LogSo3(kMapTilt).norm(), 1e-9);
}

TEST_F(LevelTrackTest, TheLastEstimateTellsWhatIsLevel) {
  LevelTrack track(folder_.path());
  FilterReport unsure = ReportAt(0.0);
  unsure.nav.T_world_imu.rotation = ExpSo3(Vector3(0.3, 0.0, 0.0));
  track.Add(unsure, {});
  EXPECT_GT(LogSo3(track.R_level_map() * kMapTilt).norm(), 0.1);
  track.Add(ReportAt(10.0), {});
  EXPECT_LT((track.R_level_map() * kMapTilt * Vector3::UnitZ() - Vector3::UnitZ()).norm(), 1e-9);
}

// A report after which this is known of the clocks.
FilterReport WithClock(double x_m, double offset_s, double rate) {
  FilterReport report = ReportAt(x_m);
  ClockEstimate clock{{offset_s, rate}, Eigen::Matrix2d::Zero(), report.nav.stamp};
  clock.cov.diagonal() = Eigen::Vector2d(1e-4, 1e-7).cwiseAbs2();
  report.found_clock = clock;
  return report;
}

// The clock offset is found on the way: the stamps of before are corrected afterwards.
TEST_F(LevelTrackTest, StampsAreCorrectedByTheClockOffsetThatIsFound) {
  LevelTrack track(folder_.path());
  track.Add(ReportAt(1.0), {});
  track.Add(ReportAt(2.0), Duration{-4'000'000});
  track.Add(WithClock(3.0, -0.025, 0.0), Duration{-25'000'000});
  track.Finish();
  const StampedPoses poses = ReadTrajectory(File("trajectory_level.tum")).poses;
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_EQ(poses[0].stamp, ReportAt(1.0).nav.stamp - Duration{25'000'000});
  EXPECT_EQ(poses[1].stamp, ReportAt(2.0).nav.stamp - Duration{21'000'000});
  EXPECT_EQ(poses[2].stamp, ReportAt(3.0).nav.stamp);
}

// Clocks drift apart, so the offset of the end is not that of the begin. More rows than are read at
// once.
TEST_F(LevelTrackTest, StampsHaveTheOffsetOfTheirOwnTime) {
  constexpr double kRate = 50e-6;
  constexpr int kNumRows = 3000;
  LevelTrack track(folder_.path());
  for (int i = 0; i < kNumRows; ++i) {
    const double t_s = 0.1 * i;
    track.Add(t_s < 10.0 ? ReportAt(t_s) : WithClock(t_s, kRate * t_s, kRate),
              t_s < 10.0 ? Duration{} : Duration::FromSeconds(kRate * t_s));
  }
  track.Finish();
  const StampedPoses poses = ReadTrajectory(File("trajectory_level.tum")).poses;
  ASSERT_EQ(poses.size(), static_cast<std::size_t>(kNumRows));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double t_s = 0.1 * static_cast<double>(i);
    const double expected_s = t_s < 10.0 ? kRate * t_s : 0.0;
    EXPECT_NEAR(SecondsBetween(ReportAt(t_s).nav.stamp, poses[i].stamp), expected_s, 2e-6) << t_s;
  }
}

// The extrinsic is corrected on the way: the body of before was another one on the same lidar.
TEST_F(LevelTrackTest, BodyIsThatOfTheLastExtrinsic) {
  const Pose T_old_lidar{ExpSo3(Vector3(0.0, 0.0, 0.1)), Vector3(1.0, 0.0, 0.5)};
  const Pose T_new_lidar{Quaternion::Identity(), Vector3(0.2, 0.0, 0.5)};
  FilterReport before = ReportAt(1.0);
  before.nav.T_map_imu = before.nav.T_map_imu * T_new_lidar * T_old_lidar.Inverse();
  before.T_imu_lidar = T_old_lidar;
  FilterReport after = ReportAt(2.0);
  after.T_imu_lidar = T_new_lidar;
  LevelTrack track(folder_.path());
  track.Add(before, {});
  track.Add(after, {});
  track.Finish();
  const StampedPoses poses = ReadTrajectory(File("trajectory_level.tum")).poses;
  ASSERT_EQ(poses.size(), 2u);
  const Pose step = poses[0].pose.Inverse() * poses[1].pose;
  const Pose expected = ReportAt(1.0).nav.T_map_imu.Inverse() * ReportAt(2.0).nav.T_map_imu;
  EXPECT_LT(LogSe3(expected.Inverse() * step).norm(), 1e-7);
}

TEST_F(LevelTrackTest, CovarianceHasTheStepToTheWorldsEstimate) {
  LevelTrack track(folder_.path());
  FilterReport report = ReportAt(50.0);
  track.Add(report, {});
  track.Finish();
  const std::string text = test::ReadText(File("covariance_level.csv"));
  EXPECT_TRUE(text.starts_with("t_s,cov_x_x,"));
  const Pose level = Pose{track.R_level_map(), Vector3::Zero()} * report.nav.T_map_imu;
  const double step_m = report.nav.T_world_imu.translation.x() - level.translation.x();
  const std::size_t row = text.find('\n') + 1;
  const std::size_t value = text.find(',', row) + 1;
  EXPECT_NEAR(std::stod(text.substr(value)), 0.04 + step_m * step_m, 1e-9);
}

TEST_F(LevelTrackTest, WithoutGravityNothingIsWritten) {
  LevelTrack track(folder_.path());
  FilterReport report = ReportAt(1.0);
  report.g_world_mps2.setZero();
  track.Add(report, {});
  track.Finish();
  EXPECT_EQ(track.R_level_map().coeffs(), Quaternion::Identity().coeffs());
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(LevelTrackTest, FilesOfAnEarlierRunAreRemoved) {
  {
    LevelTrack track(folder_.path());
    track.Add(ReportAt(1.0), {});
    track.Finish();
  }
  ASSERT_TRUE(fs::exists(File("trajectory_level.tum")));
  LevelTrack again(folder_.path());
  EXPECT_FALSE(fs::exists(File("trajectory_level.tum")));
  again.Finish();
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(LevelTrackTest, AFolderThatIsNoneIsNamed) {
  EXPECT_THROW(LevelTrack(folder_.path() / "missing"), std::runtime_error);
}

}  // namespace
}  // namespace lio
