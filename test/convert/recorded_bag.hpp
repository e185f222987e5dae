// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Makes a recorded drive as drivers publish it: thirty sweeps of the spinning lidar, its IMU and a
// truth topic; and the fixture that writes it into bags and converts them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>

#include "lio/convert/rosbag_convert.hpp"
#include "support/lidar_drivers.hpp"
#include "support/lio_log.hpp"
#include "support/temp_dir.hpp"

namespace lio::test {

inline constexpr Timestamp kRecordingBegin{1'556'268'000'000'000'000};
inline constexpr int kNumSweeps = 30;

// Holds the cloud and its points in its order (those that are not NaN).
struct PublishedCloud {
  TestCloud cloud;
  std::vector<SeenPoint> points;
};

inline PublishedCloud Publish(const Driver& driver, const SpinningLidar& lidar, int k,
                              Timestamp start) {
  std::vector<SeenPoint> seen = SeePoints(lidar, k);
  if (driver.organised) {
    std::stable_sort(seen.begin(), seen.end(), [](auto& a, auto& b) { return a.ring > b.ring; });
  }
  if (driver.shuffled) std::shuffle(seen.begin(), seen.end(), std::mt19937(9));
  PublishedCloud published;
  TestCloud& cloud = published.cloud;
  cloud.stamp = driver.stamp_is_end ? start + Duration::FromSeconds(CloudSeconds(lidar)) : start;
  cloud.fields = driver.fields;
  cloud.point_step = driver.point_step;
  if (driver.organised) cloud.height = static_cast<std::uint32_t>(lidar.num_rings);
  cloud.Resize(seen.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    StorePoint(cloud, i, seen[i]);
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
  std::vector<std::vector<SeenPoint>> points;  // in the order of time
};

using WriteMessage = std::function<void(const std::string& topic, const std::string& type,
                                        Timestamp received, const std::vector<std::uint8_t>&)>;

// Records sweeps one after another, a 100 Hz IMU and a truth topic, in the order of reception.
inline Recording Record(const Driver& driver, const WriteMessage& write, const RosBytes& form) {
  const SpinningLidar lidar;
  Recording recording;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> late(0.004, 0.007);
  std::int64_t next_imu = 0;
  const auto imu_until = [&](Timestamp end) {
    for (;; ++next_imu) {
      const Timestamp stamp = kRecordingBegin + Duration{next_imu * 10'000'000};
      const Timestamp received = stamp + Duration::FromSeconds(0.002);
      if (received > end) return;
      write("/imu", "Imu", received,
            ImuMessage(
                {stamp, {0.0, 0.0, 0.1}, {0.0, 0.0, 9.8 + 0.001 * static_cast<double>(next_imu)}},
                form));
      if (next_imu % 20 == 0) {
        write("/truth", "Odometry", received,
              OdometryMessage(
                  {stamp, {Quaternion::Identity(), {0.1 * static_cast<double>(next_imu), 0, 0}}},
                  form));
      }
    }
  };
  for (int k = 0; k < kNumSweeps; ++k) {
    const Timestamp start = kRecordingBegin + Duration::FromSeconds(k * CloudSeconds(lidar));
    const Timestamp received = start + Duration::FromSeconds(CloudSeconds(lidar) + late(random));
    imu_until(received);
    const PublishedCloud published = Publish(driver, lidar, k, start);
    write("/points", "PointCloud2", received, CloudMessage(published.cloud, form));
    recording.starts.push_back(start);
    recording.received.push_back(received);
    recording.points.push_back(published.points);
  }
  return recording;
}

inline std::string FullType(const std::string& type, const std::string& middle) {
  return (type == "Odometry" ? "nav_msgs" : "sensor_msgs") + middle + type;
}

class RosbagConversion : public testing::Test {
 protected:
  Recording WriteBag1(const Driver& driver, const Bag1Writer::Options& options = {}) {
    Bag1Writer writer(dir_.path() / "drive.bag", options);
    const auto recording = Record(
        driver,
        [&](auto& topic, auto& type, Timestamp received, auto& data) {
          writer.Write(topic, FullType(type, "/"), received, data);
        },
        RosBytes());
    writer.Close();
    options_.input = dir_.path() / "drive.bag";
    return recording;
  }
  Recording WriteBag2(const Driver& driver, bool big_endian) {
    Bag2Writer writer(dir_.path() / "drive", 500);
    const auto recording = Record(
        driver,
        [&](auto& topic, auto& type, Timestamp received, auto& data) {
          writer.Write(topic, FullType(type, "/msg/"), received, data);
        },
        RosBytes(RosEncoding::kCdr, big_endian));
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
  LioLog Log() const { return ReadLioLog(options_.output); }

  void ExpectSame(const Recording& recording, const LioLog& log, const Driver& driver) {
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

  TempDir dir_;
  RosbagOptions options_;
};

}  // namespace lio::test
