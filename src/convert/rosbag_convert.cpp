// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/rosbag_convert.hpp"

#include <algorithm>

#include "cloud_to_sweep.hpp"
#include "convert/ordered_log.hpp"
#include "lio/io/input_error.hpp"
#include "livox_message.hpp"
#include "plain_bag.hpp"

namespace lio {
namespace {

// Without an index, topics are searched for in this much of the bag's beginning.
constexpr double kTopicSearchSeconds = 30.0;

bool HasScans(const std::vector<BagTopic>& topics) {
  return std::any_of(topics.begin(), topics.end(), [](const BagTopic& topic) {
    return IsScanType(topic.type) && topic.num_messages > 0;
  });
}

std::vector<BagTopic> FindTopics(const RosbagOptions& options) {
  const auto bag = OpenBag(options.input);
  if (bag->knows_all_topics()) return bag->topics();
  BagMessage message;
  bool searched = false;
  while (!searched && bag->Next(message)) {
    searched = SecondsBetween(*bag->begin_time(), message.received) > kTopicSearchSeconds;
  }
  const BagDamage& damage = bag->damage();
  if (damage.lost_bytes > 0 && !HasScans(bag->topics())) {
    throw InputError(options.input.string() + ": damaged before its first scan, " +
                     std::to_string(damage.lost_bytes) +
                     " bytes lost; first: " + damage.first_reason);
  }
  return bag->topics();
}

class RosbagConversion {
 public:
  RosbagConversion(const RosbagOptions& options, RosbagReport& report)
      : options_(options), report_(report), to_sweep_(report.rules), log_(options.output) {
    if (options.truth_file) truth_.emplace(TruthTopic(), *options.truth_file);
  }

  void Run();

 private:
  BagTopic TruthTopic() const;
  bool IsWanted(const BagTopic& topic) const;
  bool IsInTime(const BagReader& bag, Timestamp received, bool& is_over) const;
  void AddImu(const BagTopic& topic, const BagMessage& message);
  void AddCloud(const BagTopic& topic, const BagMessage& message);
  void AddSweep(const TimedSweep& sweep, Timestamp stamp, Timestamp received);
  void Finish(const BagReader& bag);

  const RosbagOptions& options_;
  RosbagReport& report_;
  CloudToSweep to_sweep_;
  OrderedLog log_;
  std::optional<TruthSource> truth_;
  std::int32_t imu_seq_ = 0;
  std::int32_t scan_seq_ = 0;
};

BagTopic RosbagConversion::TruthTopic() const {
  const auto found = std::find_if(
      report_.all_topics.begin(), report_.all_topics.end(), [&](const BagTopic& topic) {
        return topic.name == report_.topics.truth && IsTruthType(topic.type);
      });
  return *found;  // the name was chosen from this list
}

bool RosbagConversion::IsWanted(const BagTopic& topic) const {
  const TopicChoice& topics = report_.topics;
  return (topic.name == topics.lidar && IsScanType(topic.type)) ||
         (topic.name == topics.imu && topic.type == "sensor_msgs/Imu") ||
         (truth_ && topic.name == topics.truth && IsTruthType(topic.type));
}

bool RosbagConversion::IsInTime(const BagReader& bag, Timestamp received, bool& is_over) const {
  const double since_begin_s = SecondsBetween(*bag.begin_time(), received);
  const double after_start_s = since_begin_s - options_.start_s;
  // Messages of neighbouring times may have been recorded in the other order.
  constexpr double kDisorderSeconds = 5.0;
  is_over = options_.duration_s && after_start_s > *options_.duration_s + kDisorderSeconds;
  return after_start_s >= 0.0 && (!options_.duration_s || after_start_s < *options_.duration_s);
}

void RosbagConversion::Run() {
  const auto bag = OpenBag(options_.input);
  bag->Select([this](const BagTopic& topic) { return IsWanted(topic); });
  BagMessage message;
  bool is_over = false;
  while (!is_over && bag->Next(message)) {
    if (options_.progress) {
      options_.progress(static_cast<double>(bag->position_bytes()) /
                        static_cast<double>(std::max<std::int64_t>(1, bag->size_bytes())));
    }
    if (!IsInTime(*bag, message.received, is_over)) continue;
    const BagTopic& topic = bag->topics()[message.topic];
    if (topic.type == "sensor_msgs/Imu") {
      AddImu(topic, message);
    } else if (IsScanType(topic.type)) {
      AddCloud(topic, message);
    } else {
      truth_->Add(message);
    }
  }
  Finish(*bag);
}

void RosbagConversion::AddImu(const BagTopic& topic, const BagMessage& message) {
  const auto sample = DecodeRosImu(message.data, topic.encoding);
  if (!sample) {
    ++report_.num_damaged[topic.name + ": length does not fit the type"];
    return;
  }
  report_.imu.Add(sample->stamp, message.received);
  report_.accelerometer.Add(*sample);
  log_.Add(message.received, kImuChannel, EncodeImu(*sample, imu_seq_++));
}

void RosbagConversion::AddCloud(const BagTopic& topic, const BagMessage& message) {
  const auto cloud = DecodeScan(topic, message.data);
  if (!cloud) {
    ++report_.num_damaged[topic.name + ": sizes or fields are inconsistent"];
    return;
  }
  TimedSweep sweep;
  const CloudStatus status = to_sweep_.Convert(*cloud, sweep);
  if (status == CloudStatus::kWrongFields) {
    ++report_.num_damaged[topic.name + ": fields differ from those of the first clouds"];
    return;
  }
  report_.num_points_nonfinite += to_sweep_.points().num_nonfinite;
  report_.num_points_zero += to_sweep_.points().num_zero;
  report_.num_points_noise += to_sweep_.points().num_noise;
  if (status == CloudStatus::kBadTime) {
    ++report_.num_damaged[topic.name + ": point times form no sweep near the stamp"];
  } else if (status == CloudStatus::kEmpty) {
    ++report_.num_empty;
  } else {
    AddSweep(sweep, cloud->stamp, message.received);
  }
}

void RosbagConversion::AddSweep(const TimedSweep& sweep, Timestamp stamp, Timestamp received) {
  report_.lidar.Add(stamp, received);
  report_.num_points += static_cast<std::int64_t>(sweep.points.size());
  report_.longest_sweep_s =
      std::max(report_.longest_sweep_s, SecondsBetween(sweep.first, sweep.last));
  const std::size_t max_points =
      options_.whole_scans ? sweep.points.size() : std::size_t{kMaxChunkPoints};
  for (const SentChunk& sent : SplitSweep(sweep, scan_seq_++, received, max_points)) {
    log_.Add(sent.sent, kScanChannel, EncodeChunk(sent.chunk));
  }
}

void RosbagConversion::Finish(const BagReader& bag) {
  log_.Close();
  if (truth_) {
    truth_->Close();
    report_.truth = truth_->counts();
    report_.truth_description = truth_->description();
  }
  report_.damage = bag.damage();
  report_.num_events = log_.num_events();
  report_.num_late_events = log_.num_late();
  for (const BagTopic& topic : bag.topics()) {
    const bool is_new = std::none_of(report_.all_topics.begin(), report_.all_topics.end(),
                                     [&](const BagTopic& other) {
                                       return other.name == topic.name && other.type == topic.type;
                                     });
    const bool is_sensor = IsScanType(topic.type) || topic.type == "sensor_msgs/Imu";
    if (is_new && is_sensor) {
      report_.notes.push_back(topic.name + " (" + topic.type +
                              ") began later and was left out: name the topics to choose");
    }
  }
  report_.all_topics = bag.topics();
}

}  // namespace

bool RosbagReport::IsDamaged() const {
  return damage.Any() || !num_damaged.empty() || (truth && truth->num_damaged > 0);
}

RosbagReport ConvertRosbag(const RosbagOptions& wishes) {
  const PlainBag bag(wishes.input);
  RosbagOptions options = wishes;
  options.input = bag.path();
  RosbagReport report;
  report.all_topics = FindTopics(options);
  report.topics = ChooseTopics(report.all_topics, options);
  report.rules = ProbeClouds(report.topics, options);
  RosbagConversion(options, report).Run();
  if (report.lidar.num() == 0) {
    throw InputError(report.topics.lidar + ": there is no sweep in the requested part");
  }
  return report;
}

}  // namespace lio
