// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/rosbag_convert.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>

#include "lio/io/input_error.hpp"
#include "lio/io/trajectory_file.hpp"
#include "support/lidar_drivers.hpp"
#include "support/lio_log.hpp"
#include "support/temp_dir.hpp"

namespace lio {
namespace {

using test::Driver;
using test::Drivers;
using test::SeenPoint;
using test::TestCloud;

constexpr Timestamp kBegin{1'556'268'000'000'000'000};
constexpr int kNumSweeps = 30;

// The cloud, and its points in its order (those that are not NaN).
struct Published {
  TestCloud cloud;
  std::vector<SeenPoint> points;
};

Published Publish(const Driver& driver, const test::SpinningLidar& lidar, int k, Timestamp start) {
  std::vector<SeenPoint> seen = test::SeePoints(lidar, k);
  if (driver.organised) {
    std::stable_sort(seen.begin(), seen.end(), [](auto& a, auto& b) { return a.ring > b.ring; });
  }
  if (driver.shuffled) std::shuffle(seen.begin(), seen.end(), std::mt19937(9));
  Published published;
  TestCloud& cloud = published.cloud;
  cloud.stamp = driver.stamp_is_end ? start + Duration::FromSeconds(CloudSeconds(lidar)) : start;
  cloud.fields = driver.fields;
  cloud.point_step = driver.point_step;
  if (driver.organised) cloud.height = static_cast<std::uint32_t>(lidar.num_rings);
  cloud.Resize(seen.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    test::StorePoint(cloud, i, seen[i]);
    if (driver.ring_from_top) cloud.Set(i, "ring", lidar.num_rings - 1 - seen[i].ring);
    driver.store_time(cloud, i, seen[i], start);
    if (driver.organised && i % 17 == 5) {
      for (const char* name : {"x", "y", "z"}) {
        cloud.Set(i, name, std::numeric_limits<double>::quiet_NaN());
      }
    } else {
      published.points.push_back(seen[i]);
    }
  }
  std::stable_sort(published.points.begin(), published.points.end(),
                   [](auto& a, auto& b) { return a.time_s < b.time_s; });
  return published;
}

struct Recording {
  std::vector<Timestamp> starts;
  std::vector<Timestamp> received;
  std::vector<std::vector<SeenPoint>> points;  // by time
};

using WriteMessage = std::function<void(const std::string& topic, const std::string& type,
                                        Timestamp received, const std::vector<std::uint8_t>&)>;

// Sweeps one after another, a 100 Hz IMU, and a truth topic, in the order of reception.
Recording Record(const Driver& driver, const WriteMessage& write, const test::RosBytes& form) {
  const test::SpinningLidar lidar;
  Recording recording;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> late(0.004, 0.007);
  std::int64_t next_imu = 0;
  const auto imu_until = [&](Timestamp end) {
    for (;; ++next_imu) {
      const Timestamp stamp = kBegin + Duration{next_imu * 10'000'000};
      const Timestamp received = stamp + Duration::FromSeconds(0.002);
      if (received > end) return;
      write("/imu", "Imu", received,
            test::ImuMessage(
                {stamp, {0.0, 0.0, 0.1}, {0.0, 0.0, 9.8 + 0.001 * static_cast<double>(next_imu)}},
                form));
      if (next_imu % 20 == 0) {
        write("/truth", "Odometry", received,
              test::OdometryMessage(
                  {stamp, {Quaternion::Identity(), {0.1 * static_cast<double>(next_imu), 0, 0}}},
                  form));
      }
    }
  };
  for (int k = 0; k < kNumSweeps; ++k) {
    const Timestamp start = kBegin + Duration::FromSeconds(k * CloudSeconds(lidar));
    const Timestamp received = start + Duration::FromSeconds(CloudSeconds(lidar) + late(random));
    imu_until(received);
    const Published published = Publish(driver, lidar, k, start);
    write("/points", "PointCloud2", received, test::CloudMessage(published.cloud, form));
    recording.starts.push_back(start);
    recording.received.push_back(received);
    recording.points.push_back(published.points);
  }
  return recording;
}

std::string FullType(const std::string& type, const std::string& middle) {
  return (type == "Odometry" ? "nav_msgs" : "sensor_msgs") + middle + type;
}

class RosbagConversion : public testing::Test {
 protected:
  Recording WriteBag1(const Driver& driver, const test::Bag1Writer::Options& options = {}) {
    test::Bag1Writer writer(dir_.path() / "drive.bag", options);
    const auto recording = Record(
        driver,
        [&](auto& topic, auto& type, Timestamp received, auto& data) {
          writer.Write(topic, FullType(type, "/"), received, data);
        },
        test::RosBytes());
    writer.Close();
    options_.input = dir_.path() / "drive.bag";
    return recording;
  }
  Recording WriteBag2(const Driver& driver, bool big_endian) {
    test::Bag2Writer writer(dir_.path() / "drive", 500);
    const auto recording = Record(
        driver,
        [&](auto& topic, auto& type, Timestamp received, auto& data) {
          writer.Write(topic, FullType(type, "/msg/"), received, data);
        },
        test::RosBytes(RosEncoding::kCdr, big_endian));
    writer.Close();
    options_.input = dir_.path() / "drive";
    return recording;
  }
  RosbagReport Convert() {
    options_.output = dir_.path() / "out.lcm";
    const RosbagReport report = ConvertRosbag(options_);
    EXPECT_FALSE(FormatReport(report, options_).empty());
    return report;
  }
  test::LioLog Log() const { return test::ReadLioLog(options_.output); }

  void ExpectSame(const Recording& recording, const test::LioLog& log, const Driver& driver) {
    ASSERT_EQ(log.sweeps.size(), recording.points.size());
    for (std::size_t k = 0; k < log.sweeps.size(); ++k) {
      const auto& sweep = log.sweeps[k];
      ASSERT_EQ(sweep.points.size(), recording.points[k].size());
      double worst_s = 0.0;
      double worst_m = 0.0;
      int num_wrong_rings = 0;
      for (std::size_t i = 0; i < sweep.points.size(); ++i) {
        const SeenPoint& seen = recording.points[k][i];
        const LidarPoint& point = sweep.points[i].point;
        const double time_s =
            SecondsBetween(recording.starts[k], Timestamp{sweep.points[i].instant_ns});
        worst_s = std::max(worst_s, std::abs(time_s - seen.time_s));
        if (driver.time_tolerance_s < 1e-6) {  // else points of one time may change places
          worst_m = std::max({worst_m, std::abs(point.x_m - seen.x), std::abs(point.y_m - seen.y),
                              std::abs(point.z_m - seen.z)});
          const bool wants_ring = driver.has_ring || driver.organised;
          num_wrong_rings += point.ring != (wants_ring ? seen.ring : 0);
          EXPECT_EQ(point.intensity, 10 + seen.ring);
        }
      }
      EXPECT_LE(worst_s, driver.time_tolerance_s) << driver.name << " sweep " << k;
      EXPECT_LE(worst_m, 1e-5) << driver.name;
      EXPECT_EQ(num_wrong_rings, 0) << driver.name;
      // The last chunk is sent when the cloud was received.
      EXPECT_EQ(sweep.last_event_utime, recording.received[k].Microseconds());
    }
  }

  test::TempDir dir_;
  RosbagOptions options_;
};

class EveryDriver : public RosbagConversion, public testing::WithParamInterface<Driver> {};

TEST_P(EveryDriver, KeepsPointsTimesAndRingsOfRos1) {
  const Recording recording = WriteBag1(GetParam(), {.compression = "lz4"});
  const RosbagReport report = Convert();
  EXPECT_FALSE(report.IsDamaged());
  ExpectSame(recording, Log(), GetParam());
}

TEST_P(EveryDriver, KeepsPointsTimesAndRingsOfRos2) {
  const Recording recording = WriteBag2(GetParam(), true);
  const RosbagReport report = Convert();
  EXPECT_FALSE(report.IsDamaged());
  ExpectSame(recording, Log(), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Layouts, EveryDriver, testing::ValuesIn(Drivers()),
                         [](const auto& test) { return test.param.name; });

TEST_F(RosbagConversion, KeepsTheImuAsItWasReceived) {
  WriteBag1(Drivers()[0]);
  const RosbagReport report = Convert();
  const auto log = Log();
  ASSERT_GT(log.imu.size(), 290u);
  for (std::size_t i = 0; i < log.imu.size(); ++i) {
    const auto& imu = log.imu[i];
    const Timestamp stamp = kBegin + Duration{static_cast<std::int64_t>(i) * 10'000'000};
    EXPECT_EQ(imu.event_utime, (stamp + Duration::FromSeconds(0.002)).Microseconds());
    EXPECT_EQ(imu.sample.stamp, stamp);
    EXPECT_EQ(imu.sample.w_imu_radps, Vector3(0.0, 0.0, 0.1));
    EXPECT_EQ(imu.sample.f_imu_mps2.z(), 9.8 + 0.001 * static_cast<double>(i));
  }
  EXPECT_NEAR(report.imu.rate_hz(), 100.0, 0.01);
}

TEST_F(RosbagConversion, SaysWhatItDetected) {
  WriteBag1(Drivers()[0]);
  const std::string text = FormatReport(Convert(), options_);
  EXPECT_NE(text.find("field 'time' in s from the stamp, sweeps of 100.9 ms"), std::string::npos)
      << text;
  EXPECT_NE(text.find("stamp        sweep start: clouds come"), std::string::npos) << text;
  EXPECT_NE(text.find("ring         from the ring field, counted from below"), std::string::npos);
  EXPECT_NE(text.find("/points: 30 sweeps at 9.889 Hz, 5760 points each"), std::string::npos)
      << text;
}

TEST_F(RosbagConversion, WritesWholeScansWhenAsked) {
  WriteBag1(Drivers()[0]);
  options_.whole_scans = true;
  Convert();
  const auto log = Log();
  ASSERT_EQ(log.sweeps.size(), 30u);
  for (const auto& sweep : log.sweeps) EXPECT_EQ(sweep.num_chunks, 1);
}

TEST_F(RosbagConversion, CutsChunksToOneDatagram) {
  WriteBag1(Drivers()[0]);
  Convert();
  EventLogReader reader(options_.output);
  LogEvent event;
  while (reader.Next(event)) EXPECT_LT(event.data.size(), 65'000u);
  for (const auto& sweep : Log().sweeps) EXPECT_EQ(sweep.num_chunks, 2);
}

TEST_F(RosbagConversion, StampsAtTheEndAreSeenWithoutPointTime) {
  Driver driver = Drivers()[5];
  driver.stamp_is_end = true;
  driver.time_tolerance_s = 3e-5;  // the end is that of the last column, not of the last point
  const Recording recording = WriteBag1(driver);
  const RosbagReport report = Convert();
  EXPECT_EQ(report.rules.spin_stamp.meaning, StampMeaning::kSweepEnd);
  const auto log = Log();
  for (std::size_t k = 0; k < log.sweeps.size(); ++k) {
    const Timestamp first{log.sweeps[k].points.front().instant_ns};
    EXPECT_NEAR(SecondsBetween(recording.starts[k], first), 0.0, 3e-4);  // a column is 0.28 ms
  }
}

TEST_F(RosbagConversion, TheStampCanBeOverridden) {
  const Recording recording = WriteBag1(Drivers()[0]);
  options_.point_time.stamp = StampMeaning::kSweepEnd;
  Convert();
  const Timestamp last{Log().sweeps[3].points.back().instant_ns};
  EXPECT_NEAR(SecondsBetween(recording.starts[3], last), 0.0, 1e-6);
}

TEST_F(RosbagConversion, StartAndDurationCount) {
  WriteBag1(Drivers()[0]);
  options_.start_s = 1.0;
  options_.duration_s = 1.0;
  Convert();
  const auto log = Log();
  EXPECT_NEAR(static_cast<double>(log.sweeps.size()), 10.0, 1.0);
  EXPECT_NEAR(static_cast<double>(log.imu.size()), 100.0, 1.0);
  options_.start_s = 1000.0;
  EXPECT_THROW(Convert(), InputError);
}

TEST_F(RosbagConversion, TruthGoesToTum) {
  WriteBag1(Drivers()[0]);
  options_.truth_file = dir_.path() / "truth.tum";
  const RosbagReport report = Convert();
  const Trajectory truth = ReadTrajectory(*options_.truth_file);
  ASSERT_EQ(static_cast<std::int64_t>(truth.poses.size()), report.truth->num_rows);
  EXPECT_EQ(truth.poses[1].stamp, kBegin + Duration{200'000'000});
  EXPECT_NEAR(truth.poses[1].pose.translation.x(), 2.0, 1e-9);
}

TEST_F(RosbagConversion, WithoutImuIsLidarOnly) {
  test::Bag1Writer writer(dir_.path() / "drive.bag");
  Record(
      Drivers()[0],
      [&](auto& topic, auto& type, Timestamp received, auto& data) {
        if (type == "PointCloud2") writer.Write(topic, "sensor_msgs/PointCloud2", received, data);
      },
      test::RosBytes());
  writer.Close();
  options_.input = dir_.path() / "drive.bag";
  const RosbagReport report = Convert();
  EXPECT_FALSE(report.topics.imu);
  EXPECT_TRUE(Log().imu.empty());
  EXPECT_NE(FormatReport(report, options_).find("lidar-only"), std::string::npos);
}

// Bags whose tenth messages are spoilt by `spoil`.
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
          writer.Write(topic, FullType(type, "/"), received, hit ? spoil(data) : data);
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
  EXPECT_NE(FormatReport(report, options_).find("3 messages passed over, /points"),
            std::string::npos);
}

TEST_F(SpoiltBag, CloudsWithOtherFieldsArePassedOverAndCounted) {
  TestCloud other;
  other.fields = test::Fields({});
  other.point_step = 12;
  other.stamp = kBegin;
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
  TestCloud wild = test::VelodyneCloud(kBegin, test::SeePoints(lidar, 0));
  wild.Set(100, "time", 77.0);
  const RosbagReport report =
      ConvertSpoilt("PointCloud2", [&](auto) { return test::CloudMessage(wild); });
  EXPECT_TRUE(report.IsDamaged());
  EXPECT_EQ(Log().sweeps.size(), 27u);
}

TEST_F(SpoiltBag, EmptyCloudsAreNoDamage) {
  TestCloud empty = test::VelodyneCloud(kBegin, {});
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
      FormatReport(report, options_);
    } catch (const InputError&) {
    } catch (const UsageError&) {
    }
  }
}

TEST_F(RosbagConversion, MemoryDoesNotGrowWithDisorder) {
  // A clock that jumps by an hour and back must not hold events back for ever.
  test::Bag1Writer writer(dir_.path() / "drive.bag");
  const test::SpinningLidar lidar;
  for (int k = 0; k < 40; ++k) {
    const Timestamp stamp = kBegin + Duration::FromSeconds(k * CloudSeconds(lidar));
    const Duration jump = Duration::FromSeconds(k >= 20 && k < 25 ? 3600.0 : 0.0);
    writer.Write("/points", "sensor_msgs/PointCloud2", stamp + Duration::FromSeconds(0.105) + jump,
                 test::CloudMessage(test::VelodyneCloud(stamp, test::SeePoints(lidar, k))));
  }
  writer.Close();
  options_.input = dir_.path() / "drive.bag";
  options_.output = dir_.path() / "out.lcm";
  const RosbagReport report = ConvertRosbag(options_);
  EXPECT_EQ(report.lidar.num(), 40);
  EventLogReader reader(options_.output);
  LogEvent event;
  std::int64_t last = 0;
  while (reader.Next(event)) {
    EXPECT_GE(event.utime, last);
    last = event.utime;
  }
}

}  // namespace
}  // namespace lio
