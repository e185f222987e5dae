// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/kitti_odometry.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lio/io/input_error.hpp"
#include "lio/io/trajectory_file.hpp"
#include "support/lio_log.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

constexpr int kNumSequenceScans = 4;
// The camera's axes are z forward, x right, y down; it is 27 cm behind the lidar and 8 cm below.
const Pose kCameraLidar = {Quaternion((Matrix3() << 0, -1, 0, 0, 0, -1, 1, 0, 0).finished()),
                           {0.0, -0.08, -0.27}};

std::string Row(const Pose& pose) {
  const Matrix3 R = pose.rotation.toRotationMatrix();
  std::string text;
  for (int i = 0; i < 3; ++i) {
    text += fmt::format("{:.12g} {:.12g} {:.12g} {:.12g} ", R(i, 0), R(i, 1), R(i, 2),
                        pose.translation[i]);
  }
  text.back() = '\n';
  return text;
}

class KittiOdometry : public testing::Test {
 protected:
  KittiOdometry() {
    std::string times, poses;
    for (int k = 0; k < kNumSequenceScans; ++k) {
      times += fmt::format("{:e}\n", 0.1037 * k);
      // The lidar drives forward and turns; the file holds the camera's poses.
      T_lidar0_lidar_.push_back({ExpSo3({0.0, 0.01 * k, 0.1 * k}), {1.0 * k, 0.1 * k * k, 0.0}});
      poses += Row(kCameraLidar * T_lidar0_lidar_.back() * kCameraLidar.Inverse());
      // The scan has two points of the top ring, to the left and to the right, and the next ring's
      // first.
      const float values[] = {10.0f, 1.0f, 2.0f,  0.5f, 10.0f, -5.0f,
                              2.0f,  0.5f, 10.0f, 1.0f, 1.0f,  0.1f};
      dir_.Write(fmt::format("sequences/05/velodyne/{:06}.bin", k),
                 std::string(reinterpret_cast<const char*>(values), sizeof values));
    }
    dir_.Write("sequences/05/times.txt", times);
    dir_.Write("sequences/05/calib.txt", "P0: 1 0 0 0 0 1 0 0 0 0 1 0\nTr: " + Row(kCameraLidar));
    dir_.Write("poses/05.txt", poses);
    options_.sequence = dir_.path() / "sequences/05";
    options_.output = dir_.path() / "out.lcm";
    options_.truth_file = dir_.path() / "truth.tum";
  }
  test::TempDir dir_;
  KittiOdometryOptions options_;
  std::vector<Pose> T_lidar0_lidar_;
};

TEST_F(KittiOdometry, ScansHaveOneInstantEach) {
  const KittiOdometryReport report = ConvertKittiOdometry(options_);
  EXPECT_FALSE(report.IsDamaged());
  const auto log = test::ReadLioLog(options_.output);
  EXPECT_TRUE(log.imu.empty());
  ASSERT_EQ(log.sweeps.size(), static_cast<std::size_t>(kNumSequenceScans));
  for (int k = 0; k < kNumSequenceScans; ++k) {
    const auto& sweep = log.sweeps[static_cast<std::size_t>(k)];
    ASSERT_EQ(sweep.points.size(), 3u);
    for (const auto& point : sweep.points) EXPECT_EQ(point.instant_ns, 103'700'000 * k);
    EXPECT_EQ(sweep.points[0].point.ring, 63);
    EXPECT_EQ(sweep.points[2].point.ring, 62);
  }
}

TEST_F(KittiOdometry, PosesAreTurnedIntoTheLidarsFrame) {
  const KittiOdometryReport report = ConvertKittiOdometry(options_);
  EXPECT_EQ(report.num_truth_rows, kNumSequenceScans);
  const Trajectory truth = ReadTrajectory(*options_.truth_file);
  ASSERT_EQ(truth.poses.size(), static_cast<std::size_t>(kNumSequenceScans));
  for (std::size_t k = 0; k < truth.poses.size(); ++k) {
    EXPECT_EQ(truth.poses[k].stamp.ns, 103'700'000 * static_cast<std::int64_t>(k));
    EXPECT_TRUE(truth.poses[k].pose.translation.isApprox(T_lidar0_lidar_[k].translation, 1e-6));
    EXPECT_NEAR(truth.poses[k].pose.rotation.angularDistance(T_lidar0_lidar_[k].rotation), 0.0,
                1e-6);
  }
}

TEST_F(KittiOdometry, PosesCanBeNamed) {
  std::filesystem::rename(dir_.path() / "poses/05.txt", dir_.path() / "mine.txt");
  EXPECT_THROW((void)ConvertKittiOdometry(options_), InputError);
  options_.poses_file = dir_.path() / "mine.txt";
  EXPECT_EQ(ConvertKittiOdometry(options_).num_truth_rows, kNumSequenceScans);
  options_.poses_file = dir_.path() / "none.txt";
  EXPECT_THROW((void)ConvertKittiOdometry(options_), InputError);
}

TEST_F(KittiOdometry, VerticalCorrectionRaisesEveryPoint) {
  (void)ConvertKittiOdometry(options_);
  const auto before = test::ReadLioLog(options_.output);
  options_.vertical_correction_deg = 0.205;
  (void)ConvertKittiOdometry(options_);
  const auto after = test::ReadLioLog(options_.output);
  for (std::size_t i = 0; i < 3; ++i) {
    const LidarPoint& a = before.sweeps[0].points[i].point;
    const LidarPoint& b = after.sweeps[0].points[i].point;
    const auto elevation = [](const LidarPoint& p) {
      return std::atan2(p.z_m, std::hypot(p.x_m, p.y_m));
    };
    EXPECT_NEAR((elevation(b) - elevation(a)) * 180.0 / std::numbers::pi, 0.205, 1e-4);
    EXPECT_NEAR(std::atan2(b.y_m, b.x_m), std::atan2(a.y_m, a.x_m), 1e-6);
    EXPECT_NEAR(std::hypot(b.x_m, b.y_m, b.z_m), std::hypot(a.x_m, a.y_m, a.z_m), 1e-5);
  }
}

TEST_F(KittiOdometry, MissingScansAndPosesAreCounted) {
  std::filesystem::remove(dir_.path() / "sequences/05/velodyne/000001.bin");
  dir_.Write("poses/05.txt", Row({}) + Row({}));
  const KittiOdometryReport report = ConvertKittiOdometry(options_);
  EXPECT_TRUE(report.IsDamaged());
  EXPECT_EQ(report.num_scans_missing, 1);
  EXPECT_EQ(report.num_poses_missing, 2);
  EXPECT_NE(FormatReport(report, options_).find("1 scans missing"), std::string::npos);
}

TEST_F(KittiOdometry, WrongFilesAreRefused) {
  dir_.Write("sequences/05/calib.txt", "P0: 1 2 3\n");
  EXPECT_THROW((void)ConvertKittiOdometry(options_), InputError);
  options_.truth_file.reset();
  EXPECT_NO_THROW((void)ConvertKittiOdometry(options_));  // the poses are not needed without truth
  dir_.Write("sequences/05/times.txt", "0.0\n0.1\n0.1\n");
  EXPECT_THROW((void)ConvertKittiOdometry(options_), InputError);
  std::filesystem::remove_all(dir_.path() / "sequences/05/velodyne");
  EXPECT_THROW((void)ConvertKittiOdometry(options_), InputError);
}

}  // namespace
}  // namespace lio
