// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Runs the converters on the real recordings: counts, time spans, rebuilt point times, truth.
#include "support/shared_data.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "lio/convert/kitti_odometry.hpp"
#include "lio/convert/kitti_raw.hpp"
#include "lio/convert/rosbag_convert.hpp"
#include "lio/io/trajectory_file.hpp"
#include "support/lio_log.hpp"
#include "support/mcap_writer.hpp"
#include "support/ros_bag.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

RosbagOptions Options(const fs::path& bag, const test::TempDir& dir) {
  RosbagOptions options;
  options.input = bag;
  options.output = dir.path() / "out.lcm";
  return options;
}

// Copies the bag with another name for the field "time", which hides it.
fs::path HideTime(const fs::path& bag, const test::TempDir& dir) {
  const fs::path hidden = dir.path() / "hidden.bag";
  test::Bag1Writer writer(hidden);
  const auto reader = OpenBag(bag);
  BagMessage message;
  while (reader->Next(message)) {
    const BagTopic& topic = reader->topics()[message.topic];
    std::vector<std::uint8_t> data(message.data.begin(), message.data.end());
    const std::string name = "time";
    const auto field =
        std::search(data.begin(), data.begin() + std::min<std::ptrdiff_t>(300, std::ssize(data)),
                    name.begin(), name.end());
    if (topic.type == "sensor_msgs/PointCloud2") *field = 'r';
    writer.Write(topic.name, topic.type, message.received, data, topic.definition);
  }
  writer.Close();
  return hidden;
}

TEST(UlhkSample, ConvertsWithItsPointTimes) {
  LIO_REQUIRE_SHARED_DATA(bag, "ulhk_sample.bag.xz");
  const test::TempDir dir;
  RosbagOptions options = Options(bag, dir);
  options.truth_file = dir.path() / "truth.tum";
  const RosbagReport report = ConvertRosbag(options);
  EXPECT_FALSE(report.IsDamaged());
  EXPECT_EQ(report.lidar.num(), 79);
  EXPECT_EQ(report.imu.num(), 801);
  ASSERT_TRUE(report.rules.point_time);
  EXPECT_EQ(report.rules.point_time->unit, TimeUnit::kSeconds);
  EXPECT_EQ(report.rules.point_time->stamp, StampMeaning::kSweepStart);
  EXPECT_NEAR(report.imu.rate_hz(), 100.0, 0.1);
  EXPECT_NEAR(report.accelerometer.quiet_mean_mps2(), 9.8, 0.1);
  const auto log = test::ReadLioLog(options.output);
  EXPECT_EQ(log.sweeps.size(), 79u);
  EXPECT_EQ(log.sweeps[0].points.size(), 32'156u);
  EXPECT_EQ(log.sweeps[0].points.front().instant_ns, 1'556'268'000'253'000'000);
  EXPECT_NEAR(1e-9 * static_cast<double>(log.sweeps[0].points.back().instant_ns -
                                         log.sweeps[0].points.front().instant_ns),
              0.10058871, 1e-8);
  EXPECT_EQ(ReadTrajectory(*options.truth_file).poses.size(), 9u);
}

TEST(UlhkSample, RebuiltTimesAgreeWithTheHiddenField) {
  LIO_REQUIRE_SHARED_DATA(bag, "ulhk_sample.bag.xz");
  const test::TempDir dir;
  const test::TempDir hidden_dir;
  const RosbagOptions options = Options(bag, dir);
  const RosbagOptions hidden = Options(HideTime(bag, hidden_dir), hidden_dir);
  (void)ConvertRosbag(options);
  const RosbagReport report = ConvertRosbag(hidden);
  EXPECT_FALSE(report.rules.point_time);
  const auto with = test::ReadLioLog(options.output);
  const auto without = test::ReadLioLog(hidden.output);
  ASSERT_EQ(with.sweeps.size(), without.sweeps.size());
  double sum_s = 0.0;
  double worst_s = 0.0;
  std::int64_t num = 0;
  for (std::size_t k = 0; k < with.sweeps.size(); ++k) {
    const auto& a = with.sweeps[k].points;
    const auto& b = without.sweeps[k].points;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(a[i].point.x_m, b[i].point.x_m) << "the order in time differs";
      const double error_s =
          1e-9 * std::abs(static_cast<double>(a[i].instant_ns - b[i].instant_ns));
      sum_s += error_s;
      worst_s = std::max(worst_s, error_s);
      ++num;
    }
  }
  RecordProperty("mean_error_us", std::to_string(1e6 * sum_s / static_cast<double>(num)));
  RecordProperty("worst_error_us", std::to_string(1e6 * worst_s));
  std::cout << "rebuilt point time against the field: mean "
            << 1e6 * sum_s / static_cast<double>(num) << " us, worst " << 1e6 * worst_s << " us of "
            << num << " points\n";
  EXPECT_LT(worst_s, 50e-6);
}

TEST(UlhkSampleWithoutTime, ConvertsByAzimuth) {
  LIO_REQUIRE_SHARED_DATA(bag, "ulhk_sample_notime.bag.xz");
  const test::TempDir dir;
  const RosbagOptions options = Options(bag, dir);
  const RosbagReport report = ConvertRosbag(options);
  EXPECT_FALSE(report.IsDamaged());
  EXPECT_EQ(report.topics.lidar, "/velodyne_points_0");
  EXPECT_EQ(report.rules.spin_stamp.meaning, StampMeaning::kSweepStart);
  EXPECT_EQ(report.rules.spin.direction, -1.0);
  const auto log = test::ReadLioLog(options.output);
  EXPECT_EQ(log.sweeps.size(), 59u);
  for (const auto& sweep : log.sweeps) {
    const double span_s = 1e-9 * static_cast<double>(sweep.points.back().instant_ns -
                                                     sweep.points.front().instant_ns);
    EXPECT_NEAR(span_s, 0.1006, 1e-4);  // more than a turn: the sweep overlaps itself
  }
}

TEST(KittiDrive0005, ConvertsWholly) {
  LIO_REQUIRE_SHARED_DATA(data, "kitti_raw_0005_first80.tar.xz");
  const test::TempDir dir;
  KittiRawOptions options;
  options.drive = data / "kitti_raw/2011_09_26/2011_09_26_drive_0005_sync";
  options.output = dir.path() / "out.lcm";
  options.truth_file = dir.path() / "truth.tum";
  options.rig_file = dir.path() / "rig.yaml";
  options.imu_rate_hz = 100.0;  // this IMU is derived: interpolated from 10 Hz packets
  const KittiRawReport report = ConvertKittiRaw(options);
  EXPECT_FALSE(report.IsDamaged());
  EXPECT_EQ(report.lidar.num(), 80);
  EXPECT_EQ(report.num_truth_rows, 82);
  EXPECT_NEAR(report.truth_length_m, 31.0, 0.5);
  EXPECT_NEAR(report.accelerometer.mean_mps2(), 9.8, 0.1);
  const auto log = test::ReadLioLog(options.output);
  ASSERT_EQ(log.sweeps.size(), 80u);
  for (const auto& sweep : log.sweeps) {
    EXPECT_GT(sweep.points.size(), 95'000u);
    EXPECT_NEAR(1e-9 * static_cast<double>(sweep.points.back().instant_ns -
                                           sweep.points.front().instant_ns),
                0.1033, 3e-4);
    const auto ring = [](const auto& a, const auto& b) { return a.point.ring < b.point.ring; };
    const auto [low, high] = std::minmax_element(sweep.points.begin(), sweep.points.end(), ring);
    EXPECT_EQ(low->point.ring, 0);
    EXPECT_EQ(high->point.ring, 63);
  }
}

// Converts a ROS 1 message to ROS 2's form.
std::vector<std::uint8_t> InRos2Form(const BagTopic& topic, const BagMessage& message) {
  const test::RosBytes form(RosEncoding::kCdr);
  if (topic.type == "sensor_msgs/Imu") {
    return test::ImuMessage(*DecodeRosImu(message.data, topic.encoding), form);
  }
  if (topic.type == "nav_msgs/Odometry") {
    return test::OdometryMessage(*DecodeRosOdometry(message.data, topic.encoding), form);
  }
  const RosCloud cloud = *DecodeRosCloud(message.data, topic.encoding);
  return test::CloudMessage({.stamp = cloud.stamp,
                             .height = cloud.height,
                             .width = cloud.width,
                             .fields = cloud.fields,
                             .point_step = cloud.point_step,
                             .row_step = cloud.row_step,
                             .big_endian = cloud.big_endian,
                             .data = {cloud.data.begin(), cloud.data.end()}},
                            form);
}

// Most of UrbanLoco's Hong Kong data is available in ROS 2's form today.
TEST(UlhkSample, GivesTheSameLogAndTruthAsARos2Bag) {
  LIO_REQUIRE_SHARED_DATA(bag, "ulhk_sample.bag.xz");
  const test::TempDir dir;
  const test::TempDir ros2_dir;
  {
    test::Bag2Writer writer(ros2_dir.path() / "drive", 400);
    const auto reader = OpenBag(bag);
    for (BagMessage message; reader->Next(message);) {
      const BagTopic& topic = reader->topics()[message.topic];
      const std::size_t slash = topic.type.find('/');
      writer.Write(topic.name, topic.type.substr(0, slash) + "/msg" + topic.type.substr(slash),
                   message.received, InRos2Form(topic, message));
    }
    writer.Close();
  }
  RosbagOptions ros1 = Options(bag, dir);
  ros1.truth_file = dir.path() / "truth.tum";
  RosbagOptions ros2 = Options(ros2_dir.path() / "drive", ros2_dir);
  ros2.truth_file = ros2_dir.path() / "truth.tum";
  (void)ConvertRosbag(ros1);
  const RosbagReport report = ConvertRosbag(ros2);
  EXPECT_FALSE(report.IsDamaged());
  EXPECT_EQ(report.lidar.num(), 79);
  EXPECT_EQ(report.imu.num(), 801);
  EXPECT_TRUE(test::ReadText(ros1.output) == test::ReadText(ros2.output));
  EXPECT_EQ(test::ReadText(*ros1.truth_file), test::ReadText(*ros2.truth_file));
}

// ROS 2 records MCAP by default; ROS 1 bags are converted to it, too.
TEST(UlhkSample, GivesTheSameLogAndTruthAsMcapOfAnyStorage) {
  LIO_REQUIRE_SHARED_DATA(bag, "ulhk_sample.bag.xz");
  const test::TempDir dir;
  RosbagOptions ros1 = Options(bag, dir);
  ros1.truth_file = dir.path() / "truth.tum";
  (void)ConvertRosbag(ros1);
  const auto as_it_is = [](const BagTopic&, const BagMessage& message) {
    return std::vector<std::uint8_t>(message.data.begin(), message.data.end());
  };
  const std::vector<test::McapWriter::Options> storages = {
      {.compression = "", .chunk_bytes = 0},
      {.compression = "", .chunk_bytes = 786'432},
      {.compression = "lz4", .chunk_bytes = 786'432},
      {.compression = "zstd", .chunk_bytes = 4 << 20, .with_summary = false},
      {.compression = "zstd", .chunk_bytes = 786'432, .encoding = RosEncoding::kCdr}};
  for (std::size_t i = 0; i < storages.size(); ++i) {
    const test::TempDir mcap_dir;
    const fs::path file = mcap_dir.path() / "drive.mcap";
    if (storages[i].encoding == RosEncoding::kCdr) {
      test::CopyToMcap(bag, file, storages[i], InRos2Form);
    } else {
      test::CopyToMcap(bag, file, storages[i], as_it_is);
    }
    RosbagOptions mcap = Options(file, mcap_dir);
    mcap.truth_file = mcap_dir.path() / "truth.tum";
    const RosbagReport report = ConvertRosbag(mcap);
    EXPECT_FALSE(report.IsDamaged()) << i;
    EXPECT_EQ(report.lidar.num(), 79) << i;
    EXPECT_TRUE(test::ReadText(ros1.output) == test::ReadText(mcap.output)) << i;
    EXPECT_EQ(test::ReadText(*ros1.truth_file), test::ReadText(*mcap.truth_file)) << i;
  }
}

// Rearranges drive 0005 as an odometry sequence: camera poses from the OXTS truth at the scans'
// stamps, times from the first scan on.
class KittiSequenceOf0005 {
 public:
  KittiSequenceOf0005(const fs::path& day, const fs::path& target) {
    const fs::path drive = day / "2011_09_26_drive_0005_sync";
    const auto stamps = ReadKittiStamps(drive / "velodyne_points/timestamps.txt");
    auto imu_rows = ReadKittiCalibration(day / "calib_imu_to_velo.txt");
    auto camera_rows = ReadKittiCalibration(day / "calib_velo_to_cam.txt");
    const Pose T_lidar_imu = ToPose(imu_rows["R"], imu_rows["T"], "calibration");
    T_camera_lidar_ = ToPose(camera_rows["R"], camera_rows["T"], "calibration");
    std::vector<OxtsRow> rows;
    const auto oxts_stamps = ReadKittiStamps(drive / "oxts/timestamps.txt");
    for (const auto& [number, file] : NumberedFiles(drive / "oxts/data")) {
      rows.push_back(*ParseOxts(test::ReadText(file)));
      rows.back().stamp = oxts_stamps[static_cast<std::size_t>(number)];
    }
    const StampedPoses imu = OxtsPoses(rows);
    fs::create_directories(target / "sequences/50");
    fs::create_directories(target / "poses");
    fs::create_directory_symlink(drive / "velodyne_points/data", target / "sequences/50/velodyne");
    std::ofstream times(target / "sequences/50/times.txt");
    StampedPoses cameras;
    Pose T_world_lidar0;
    for (std::size_t k = 0; k < stamps.size(); ++k) {
      const Pose T_world_lidar = PoseAt(imu, stamps[k]) * T_lidar_imu.Inverse();
      if (k == 0) T_world_lidar0 = T_world_lidar;
      T_lidar0_lidar_.push_back(T_world_lidar0.Inverse() * T_world_lidar);
      cameras.push_back({Timestamp{static_cast<std::int64_t>(k)},
                         T_camera_lidar_ * T_lidar0_lidar_.back() * T_camera_lidar_.Inverse()});
      times << StampText(Timestamp{(stamps[k] - stamps[0]).ns}) << "\n";
    }
    WriteKitti(target / "poses/50.txt", cameras);
    const Matrix3 R = T_camera_lidar_.rotation.toRotationMatrix();
    std::ofstream calibration(target / "sequences/50/calib.txt");
    calibration.precision(12);
    calibration << "Tr:";
    for (int i = 0; i < 3; ++i) {
      calibration << ' ' << R(i, 0) << ' ' << R(i, 1) << ' ' << R(i, 2) << ' '
                  << T_camera_lidar_.translation[i];
    }
    calibration << "\n";
  }
  const std::vector<Pose>& T_lidar0_lidar() const { return T_lidar0_lidar_; }

 private:
  static Pose PoseAt(const StampedPoses& poses, Timestamp stamp) {
    std::size_t after = 1;
    while (after + 1 < poses.size() && poses[after].stamp < stamp) ++after;
    const auto& a = poses[after - 1];
    const auto& b = poses[after];
    return Interpolate(a.pose, b.pose,
                       SecondsBetween(a.stamp, stamp) / SecondsBetween(a.stamp, b.stamp));
  }
  Pose T_camera_lidar_;
  std::vector<Pose> T_lidar0_lidar_;
};

TEST(KittiDrive0005, ConvertsAsAnOdometrySequence) {
  LIO_REQUIRE_SHARED_DATA(data, "kitti_raw_0005_first80.tar.xz");
  const test::TempDir dir;
  const KittiSequenceOf0005 sequence(data / "kitti_raw/2011_09_26", dir.path());
  KittiOdometryOptions options;
  options.sequence = dir.path() / "sequences/50";
  options.output = dir.path() / "out.lcm";
  options.truth_file = dir.path() / "truth.tum";
  options.vertical_correction_deg = 0.205;
  const KittiOdometryReport report = ConvertKittiOdometry(options);
  EXPECT_FALSE(report.IsDamaged());
  EXPECT_EQ(report.lidar.num(), 80);
  EXPECT_NEAR(report.lidar.span_s(), 8.16, 0.01);
  EXPECT_EQ(test::ReadLioLog(options.output).sweeps.size(), 80u);
  const Trajectory truth = ReadTrajectory(*options.truth_file);
  ASSERT_EQ(truth.poses.size(), 80u);
  for (std::size_t k = 0; k < 80; ++k) {
    const Pose& expected = sequence.T_lidar0_lidar()[k];
    EXPECT_NEAR((truth.poses[k].pose.translation - expected.translation).norm(), 0.0, 1e-5);
    EXPECT_NEAR(truth.poses[k].pose.rotation.angularDistance(expected.rotation), 0.0, 1e-5);
  }
  // The lidar faces along the car: nearly all of the way is along its first x axis.
  EXPECT_GT(truth.poses.back().pose.translation.x(), 25.0);
}

}  // namespace
}  // namespace lio
