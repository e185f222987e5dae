// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/kitti_raw.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "lio/io/input_error.hpp"
#include "lio/io/options_yaml.hpp"
#include "lio/io/trajectory_file.hpp"
#include "support/lio_log.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

constexpr int kNumDriveScans = 6;
constexpr int kNumOxts = 8;
constexpr double kTurn_s = 0.104;

std::string Stamp(double seconds) {
  return fmt::format("2011-09-26 13:04:{:012.9f}\n", seconds);
}
Timestamp StampOfDrive(double seconds) {
  return Timestamp{1'317'042'240'000'000'000} + Duration::FromSeconds(seconds);
}

// Writes a small drive: scans of two rings at 20.0 s, 20.104 s, ...; OXTS at 20.015 s, 20.115 s,
// ...
class KittiRaw : public testing::Test {
 protected:
  KittiRaw() {
    std::string stamps, starts, ends, oxts;
    for (int k = 0; k < kNumDriveScans; ++k) {
      stamps += Stamp(20.0 + k * kTurn_s);
      starts += Stamp(20.0 + (k - 0.5) * kTurn_s);
      ends += Stamp(20.0 + (k + 0.5) * kTurn_s);
      dir_.Write(fmt::format("day/drive/velodyne_points/data/{:010}.bin", k), Scan());
    }
    for (int k = 0; k < kNumOxts; ++k) {
      oxts += Stamp(20.015 + 0.1 * k);
      dir_.Write(fmt::format("day/drive/oxts/data/{:010}.txt", k), Oxts(k));
    }
    dir_.Write("day/drive/velodyne_points/timestamps.txt", stamps);
    dir_.Write("day/drive/velodyne_points/timestamps_start.txt", starts);
    dir_.Write("day/drive/velodyne_points/timestamps_end.txt", ends);
    dir_.Write("day/drive/oxts/timestamps.txt", oxts);
    dir_.Write("day/calib_imu_to_velo.txt",
               "calib_time: x\nR: 0 1 0 -1 0 0 0 0 1\nT: 0.5 -0.3 -0.8\n");
    options_.drive = dir_.path() / "day/drive";
    options_.output = dir_.path() / "out.lcm";
  }

  static std::string Scan() {
    std::vector<float> values;
    for (int ring = 0; ring < 2; ++ring) {
      for (double azimuth = 0.5; azimuth < 360.0; azimuth += 1.0) {
        const double radians = azimuth * std::numbers::pi / 180.0;
        values.insert(values.end(), {static_cast<float>(10 * std::cos(radians)),
                                     static_cast<float>(10 * std::sin(radians)),
                                     static_cast<float>(-ring), 0.25f});
      }
    }
    return std::string(reinterpret_cast<const char*>(values.data()), 4 * values.size());
  }
  // The car drives east at 5 m/s and gains 1 m/s per packet; yaw is 0.1 rad; az and wz count
  // packets.
  static std::string Oxts(int k) {
    return fmt::format(
        "49 8 112 0.01 0.02 0.1 0.5 {} {} 0 0.2 0.3 0 {} 0 0 0 0 0 {} 0 0 0 0 0 4 4 4 4 0\n", 5 + k,
        5 + k, 9.8 + 0.1 * k, 0.01 * k);
  }

  test::TempDir dir_;
  KittiRawOptions options_;
};

TEST_F(KittiRaw, PointTimesFollowTheClockwiseTurn) {
  const KittiRawReport report = ConvertKittiRaw(options_);
  EXPECT_FALSE(report.IsDamaged());
  const auto log = test::ReadLioLog(options_.output);
  ASSERT_EQ(log.sweeps.size(), static_cast<std::size_t>(kNumDriveScans));
  for (int k = 0; k < kNumDriveScans; ++k) {
    const auto& points = log.sweeps[static_cast<std::size_t>(k)].points;
    ASSERT_EQ(points.size(), 720u);
    for (const auto& logged : points) {
      const double azimuth = std::atan2(logged.point.y_m, logged.point.x_m);
      const double expected = 20.0 + k * kTurn_s - azimuth / (2 * std::numbers::pi) * kTurn_s;
      EXPECT_NEAR(SecondsBetween(StampOfDrive(0), Timestamp{logged.instant_ns}), expected, 2e-8);
      EXPECT_EQ(logged.point.ring, logged.point.z_m == 0.0f ? 63 : 62);
      EXPECT_EQ(logged.point.intensity, 64);
    }
    EXPECT_EQ(log.sweeps[static_cast<std::size_t>(k)].last_event_utime,
              Timestamp{points.back().instant_ns}.Microseconds());
  }
}

TEST_F(KittiRaw, ImuIsTheOxtsAtItsOwnStamps) {
  (void)ConvertKittiRaw(options_);
  const auto log = test::ReadLioLog(options_.output);
  ASSERT_EQ(log.imu.size(), static_cast<std::size_t>(kNumOxts));
  for (int k = 0; k < kNumOxts; ++k) {
    const auto& imu = log.imu[static_cast<std::size_t>(k)];
    EXPECT_EQ(imu.event_utime, StampOfDrive(20.015 + 0.1 * k).Microseconds());
    EXPECT_NEAR(imu.sample.f_imu_mps2.z(), 9.8 + 0.1 * k, 1e-12);
    EXPECT_EQ(imu.sample.f_imu_mps2.x(), 0.3);
    EXPECT_NEAR(imu.sample.w_imu_radps.z(), 0.01 * k, 1e-12);
  }
}

TEST_F(KittiRaw, ImuRateInterpolatesLinearly) {
  options_.imu_rate_hz = 100.0;
  (void)ConvertKittiRaw(options_);
  const auto log = test::ReadLioLog(options_.output);
  ASSERT_EQ(log.imu.size(), 71u);
  for (std::size_t i = 0; i < log.imu.size(); ++i) {
    EXPECT_NEAR(SecondsBetween(StampOfDrive(20.015), log.imu[i].sample.stamp),
                0.01 * static_cast<double>(i), 1e-6);
    EXPECT_NEAR(log.imu[i].sample.f_imu_mps2.z(), 9.8 + 0.01 * static_cast<double>(i), 1e-6);
  }
}

TEST_F(KittiRaw, TruthIntegratesVelocityFromTheFirstPacket) {
  options_.truth_file = dir_.path() / "truth.tum";
  (void)ConvertKittiRaw(options_);
  const Trajectory truth = ReadTrajectory(*options_.truth_file);
  ASSERT_EQ(truth.poses.size(), static_cast<std::size_t>(kNumOxts));
  EXPECT_TRUE(truth.poses[0].pose.translation.isZero(1e-9));
  EXPECT_EQ(truth.poses[0].stamp, StampOfDrive(20.015));
  const Vector3& end = truth.poses.back().pose.translation;
  EXPECT_NEAR(end.x(), 0.7 * (5.0 + 12.0) / 2.0, 1e-6);  // east
  EXPECT_NEAR(end.y(), 0.7 * 0.5, 1e-6);                 // north
  EXPECT_NEAR(end.z(), 0.7 * 0.2, 1e-6);                 // up
  const Vector3 forward = truth.poses[0].pose.rotation * Vector3::UnitX();
  EXPECT_NEAR(std::atan2(forward.y(), forward.x()), 0.1, 1e-6);
  EXPECT_NEAR(forward.z(), -std::sin(0.02), 1e-6);  // pitch about y, nose down
}

TEST_F(KittiRaw, RigIsTheInverseOfTheCalibration) {
  options_.rig_file = dir_.path() / "rig.yaml";
  (void)ConvertKittiRaw(options_);
  const LoadResult loaded = LoadOptions({*options_.rig_file}, {});
  EXPECT_TRUE(loaded.faults.empty()) << loaded.faults.front();
  const Pose& T_imu_lidar = *loaded.options.rig.T_imu_lidar;
  const Matrix3 R_lidar_imu = (Matrix3() << 0, 1, 0, -1, 0, 0, 0, 0, 1).finished();
  const Vector3 p_imu(1.0, 2.0, 3.0);
  const Vector3 p_lidar = R_lidar_imu * p_imu + Vector3(0.5, -0.3, -0.8);
  EXPECT_TRUE((T_imu_lidar * p_lidar).isApprox(p_imu, 1e-8));
}

TEST_F(KittiRaw, RigWithoutCalibrationIsRefused) {
  std::filesystem::remove(dir_.path() / "day/calib_imu_to_velo.txt");
  EXPECT_NO_THROW((void)ConvertKittiRaw(options_));
  options_.rig_file = dir_.path() / "rig.yaml";
  EXPECT_THROW((void)ConvertKittiRaw(options_), InputError);
}

TEST_F(KittiRaw, TheDaysFolderServesWhenItHasOneDrive) {
  options_.drive = dir_.path() / "day";
  EXPECT_EQ(ConvertKittiRaw(options_).lidar.num(), kNumDriveScans);
  options_.drive = dir_.path() / "day/drive/";
  options_.rig_file = dir_.path() / "rig.yaml";
  EXPECT_EQ(ConvertKittiRaw(options_).lidar.num(), kNumDriveScans);
  std::filesystem::copy(dir_.path() / "day/drive", dir_.path() / "day/drive2",
                        std::filesystem::copy_options::recursive);
  options_.drive = dir_.path() / "day";
  EXPECT_THROW((void)ConvertKittiRaw(options_), InputError);
}

TEST_F(KittiRaw, MissingAndCutScansAreCountedAndTheRestConverted) {
  std::filesystem::remove(dir_.path() / "day/drive/velodyne_points/data/0000000002.bin");
  dir_.Write("day/drive/velodyne_points/data/0000000004.bin", Scan().substr(0, 1001));
  dir_.Write("day/drive/oxts/data/0000000003.txt", "garbage");
  const KittiRawReport report = ConvertKittiRaw(options_);
  EXPECT_TRUE(report.IsDamaged());
  EXPECT_EQ(report.num_scans_missing, 1);
  EXPECT_EQ(report.num_scans_damaged, 1);
  EXPECT_EQ(report.num_oxts_damaged, 1);
  EXPECT_EQ(test::ReadLioLog(options_.output).sweeps.size(), 4u);
  EXPECT_NE(FormatReport(report, options_).find("1 scans missing, 1 unreadable"),
            std::string::npos);
}

TEST_F(KittiRaw, WithoutScansOrPacketsIsRefused) {
  for (int k = 0; k < kNumDriveScans; ++k) {
    dir_.Write(fmt::format("day/drive/velodyne_points/data/{:010}.bin", k), "cut");
  }
  EXPECT_THROW((void)ConvertKittiRaw(options_), InputError);
  std::filesystem::remove_all(dir_.path() / "day/drive/oxts/data");
  EXPECT_THROW((void)ConvertKittiRaw(options_), InputError);
  options_.drive = dir_.path() / "none";
  EXPECT_THROW((void)ConvertKittiRaw(options_), InputError);
}

}  // namespace
}  // namespace lio
