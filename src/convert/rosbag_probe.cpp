// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "lio/base/median.hpp"
#include "lio/convert/rosbag_convert.hpp"
#include "lio/io/input_error.hpp"
#include "livox_message.hpp"

namespace lio {
namespace {

constexpr int kNumRingClouds = 10;  // rings and intensities can be judged from few clouds
constexpr int kNumTimeClouds = 60;  // rates need some seconds
constexpr std::size_t kMaxImuDelays = 2000;

struct ProbedCloud {
  const RosCloud* cloud = nullptr;
  const CloudPoints* points = nullptr;
  const PointLayout* layout = nullptr;
  Timestamp received;
  bool is_livox = false;
};

struct ProbeCounts {
  int num_read = 0;
  int num_damaged = 0;
  int num_without_xyz = 0;
  std::string fields;  // fields of the first cloud
  std::vector<double> imu_delays_s;
};

// Calls `visit` for the first `max_clouds` clouds that have points.
template <typename Visit>
ProbeCounts ForFirstClouds(const TopicChoice& topics, const RosbagOptions& options, int max_clouds,
                           Visit&& visit) {
  const auto bag = OpenBag(options.input);
  bag->Select([&](const BagTopic& topic) {
    return (topic.name == topics.lidar && IsScanType(topic.type)) ||
           (topic.name == topics.imu && topic.type == "sensor_msgs/Imu");
  });
  ProbeCounts counts;
  CloudPoints points;
  BagMessage message;
  while (counts.num_read < max_clouds && bag->Next(message)) {
    const BagTopic& topic = bag->topics()[message.topic];
    if (topic.type == "sensor_msgs/Imu") {
      const auto imu = DecodeRosImu(message.data, topic.encoding);
      if (imu && counts.imu_delays_s.size() < kMaxImuDelays) {
        counts.imu_delays_s.push_back(SecondsBetween(imu->stamp, message.received));
      }
      continue;
    }
    const auto cloud = DecodeScan(topic, message.data);
    if (!cloud) {
      ++counts.num_damaged;
      continue;
    }
    if (counts.fields.empty()) counts.fields = DescribeFields(cloud->fields);
    const auto layout = FindLayout(cloud->fields);
    if (!layout) {
      ++counts.num_without_xyz;
      continue;
    }
    ReadPoints(*cloud, *layout, points);
    if (points.size() == 0) continue;
    ++counts.num_read;
    visit(ProbedCloud{&*cloud, &points, &*layout, message.received, IsLivoxType(topic.type)});
  }
  return counts;
}

void RequireClouds(const ProbeCounts& counts, const TopicChoice& topics) {
  if (counts.num_read > 0) return;
  if (counts.num_without_xyz > 0) {
    throw InputError(topics.lidar +
                     ": its clouds have no fields x, y and z of floating point, but " +
                     counts.fields);
  }
  throw InputError(topics.lidar + ": no cloud with returns can be read (" +
                   std::to_string(counts.num_damaged) + " damaged)");
}

void DecideTime(const TopicChoice& topics, const RosbagOptions& options, CloudRules& rules) {
  std::vector<CloudObservation> clouds;
  std::string field;
  bool is_livox = false;
  const ProbeCounts counts =
      ForFirstClouds(topics, options, kNumTimeClouds, [&](const ProbedCloud& probed) {
        if (probed.points->time.empty()) return;
        const auto [first, last] =
            std::minmax_element(probed.points->time.begin(), probed.points->time.end());
        clouds.push_back({probed.cloud->stamp, probed.received, *first, *last});
        field = probed.layout->time->name;
        is_livox = probed.is_livox;
      });
  std::optional<double> imu_delay_s;
  if (!counts.imu_delays_s.empty()) imu_delay_s = UpperMedian(counts.imu_delays_s);
  PointTimeWishes wishes = options.point_time;
  if (is_livox && !wishes.stamp) wishes.stamp = StampMeaning::kSweepStart;
  rules.point_time = DetectPointTime(clouds, wishes, imu_delay_s);
  if (rules.point_time && is_livox && !options.point_time.stamp) {
    rules.point_time->stamp_reason = "CustomMsg has the first point's";
  }
  if (rules.point_time) {
    const PointTimeRule& rule = *rules.point_time;
    rules.point_time_text = fmt::format(
        "field '{}' in {}{}, sweeps of {:.1f} ms", field, Name(rule.unit),
        rule.counts_from_epoch ? " since an epoch" : " from the stamp", 1e3 * rule.sweep_s);
    rules.stamp_text = fmt::format("{}: {}", Name(rule.stamp), rule.stamp_reason);
    return;
  }
  rules.point_time_text = clouds.empty()
                              ? "rebuilt from azimuth, because the clouds have no time field"
                              : "rebuilt from azimuth, because field '" + field + "' is constant";
}

void DecideSpin(const TopicChoice& topics, const RosbagOptions& options,
                const std::optional<BeamTable>& table, CloudRules& rules) {
  LidarSpinEstimator spin;
  std::vector<CloudObservation> clouds;
  const ProbeCounts counts =
      ForFirstClouds(topics, options, kNumTimeClouds, [&](const ProbedCloud& probed) {
        spin.Add(*probed.points, AssignRings(rules.ring, *probed.points), probed.cloud->stamp);
        clouds.push_back({probed.cloud->stamp, probed.received, 0.0, 0.0});
      });
  rules.spin = spin.Decide(table);
  std::optional<double> imu_delay_s;
  if (!counts.imu_delays_s.empty()) imu_delay_s = UpperMedian(counts.imu_delays_s);
  const double sweep_s = 2.0 * std::numbers::pi / rules.spin.rate_radps;
  rules.spin_stamp = JudgeStamp(clouds, sweep_s, imu_delay_s);
  if (options.point_time.stamp) {
    rules.spin_stamp = {*options.point_time.stamp, "given by --stamp"};
  }
  rules.point_time_text += ": " + rules.spin.description;
  rules.stamp_text = fmt::format("{}: {}", Name(rules.spin_stamp.meaning), rules.spin_stamp.reason);
}

}  // namespace

CloudRules ProbeClouds(const TopicChoice& topics, const RosbagOptions& options) {
  std::optional<BeamTable> table;
  if (options.lidar_model != "generic") table = LoadBeamTable(options.lidar_model);
  CloudRules rules;
  RingObserver rings;
  float largest_intensity = 0.0f;
  const ProbeCounts counts =
      ForFirstClouds(topics, options, kNumRingClouds, [&](const ProbedCloud& probed) {
        rings.Add(*probed.points, probed.cloud->height, probed.cloud->width);
        for (const float intensity : probed.points->intensity) {
          if (intensity > largest_intensity) largest_intensity = intensity;
        }
      });
  RequireClouds(counts, topics);
  rules.fields = counts.fields;
  rules.ring = rings.Decide(table);
  // Some drivers scale the sensor's eight bits to 0..1.
  if (largest_intensity > 0.0f && largest_intensity <= 1.0f) rules.intensity_scale = 255.0f;
  DecideTime(topics, options, rules);
  if (!rules.point_time) DecideSpin(topics, options, table, rules);
  return rules;
}

}  // namespace lio
