// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Converts a recorded drive (ROS 1 or ROS 2 bag) to an LCM log: the IMU as it was received, and
// each sweep in the chunks that a driver would have sent.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "lio/convert/bag_reader.hpp"
#include "lio/convert/lidar_spin_estimator.hpp"
#include "lio/convert/point_time.hpp"
#include "lio/convert/ring_rule.hpp"
#include "lio/convert/truth_source.hpp"
#include "lio/io/stream_stats.hpp"

namespace lio {

struct RosbagOptions {
  std::filesystem::path input;
  std::filesystem::path output;
  std::optional<std::string> lidar_topic;
  std::optional<std::string> imu_topic;
  std::optional<std::string> truth_topic;
  std::optional<std::filesystem::path> truth_file;
  std::string lidar_model = "generic";
  PointTimeWishes point_time;
  double start_s = 0.0;              // from the bag's first message on
  std::optional<double> duration_s;  // from start_s on
  bool whole_scans = false;
  std::function<void(double)> progress;  // called with the share done, 0..1; may be empty
};

struct TopicChoice {
  std::string lidar;
  std::optional<std::string> imu;
  std::optional<std::string> truth;
};

// Finds topics by type if the options name none. Throws UsageError for an ambiguous topic, and for
// a named one that is missing or of a wrong type. Throws InputError when the bag has no
// PointCloud2 and no CustomMsg of a Livox lidar.
[[nodiscard]] TopicChoice ChooseTopics(const std::vector<BagTopic>& topics,
                                       const RosbagOptions& options);

// Holds the rules for reading this recording's clouds, decided from the first ones.
struct CloudRules {
  std::optional<PointTimeRule> point_time;  // empty: from azimuth, by `spin`
  SpinModel spin;
  StampJudgement spin_stamp;  // meaning of the stamps when `spin` is used
  RingRule ring;
  float intensity_scale = 1.0f;  // 255 for drivers that write 0..1
  std::string fields;            // for the user
  std::string point_time_text;
  std::string stamp_text;
};

// Reads the first clouds of the bag. Throws InputError when they cannot be interpreted, and
// UsageError for an unknown lidar model.
[[nodiscard]] CloudRules ProbeClouds(const TopicChoice& topics, const RosbagOptions& options);

struct RosbagReport {
  TopicChoice topics;
  std::vector<BagTopic> all_topics;
  CloudRules rules;
  StreamStats lidar;
  StreamStats imu;
  AccelerometerStats accelerometer;
  std::int64_t num_points = 0;
  std::int64_t num_points_nonfinite = 0;
  std::int64_t num_points_zero = 0;
  std::int64_t num_points_noise = 0;  // tagged as noise by the sensor
  double longest_sweep_s = 0.0;
  std::map<std::string, std::int64_t> num_damaged;  // messages skipped, by reason
  std::int64_t num_empty = 0;                       // clouds without one usable return
  std::int64_t num_events = 0;
  std::int64_t num_late_events = 0;
  BagDamage damage;
  std::optional<TruthCounts> truth;
  std::string truth_description;
  std::vector<std::string> notes;

  // Returns true when something was lost, which means exit code 5.
  [[nodiscard]] bool IsDamaged() const;
};

// Throws UsageError, InputError, or std::runtime_error when an output cannot be written.
[[nodiscard]] RosbagReport ConvertRosbag(const RosbagOptions& options);

// Returns the summary for the user, one "name: value" per line.
[[nodiscard]] std::string FormatReport(const RosbagReport& report, const RosbagOptions& options);

}  // namespace lio
