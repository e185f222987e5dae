// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Parses and describes the written form of faults.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "lio/sim/fault.hpp"

namespace lio::sim {
namespace {

constexpr double kToTheEnd = 1e9;  // s

struct KindText {
  FaultKind kind;
  std::string_view name;
  std::string_view meaning;
  bool has_channel;
  FaultChannel channel;  // used when the text names none
  std::vector<std::pair<std::string, double>> keys;
};

// These faults lose, repeat or delay messages.
std::vector<KindText> DeliveryKinds() {
  using K = FaultKind;
  using C = FaultChannel;
  return {
      {K::kImuGap,
       "imu_gap",
       "all IMU samples are lost",
       false,
       C::kImu,
       {{"start", 10}, {"duration", 0.6}}},
      {K::kLidarGap,
       "lidar_gap",
       "all scans are lost",
       false,
       C::kLidar,
       {{"start", 10}, {"duration", 0.6}}},
      {K::kDrop,
       "drop",
       "messages are lost at random; a lost scan loses all its chunks",
       true,
       C::kBoth,
       {{"ratio", 0.05}, {"start", 0}, {"duration", kToTheEnd}}},
      {K::kDuplicate,
       "duplicate",
       "messages arrive twice",
       true,
       C::kBoth,
       {{"ratio", 0.05}, {"delay", 0.004}, {"start", 0}, {"duration", kToTheEnd}}},
      {K::kReorder,
       "reorder",
       "messages arrive late, after newer ones",
       true,
       C::kBoth,
       {{"ratio", 0.05}, {"delay", 0.03}, {"start", 0}, {"duration", kToTheEnd}}},
      {K::kChunkLoss,
       "chunk_loss",
       "single chunks of scans are lost",
       false,
       C::kLidar,
       {{"ratio", 0.05}, {"start", 0}, {"duration", kToTheEnd}}},
  };
}

// These faults change the content of messages or of the configuration.
std::vector<KindText> ContentKinds() {
  using K = FaultKind;
  using C = FaultChannel;
  return {
      {K::kStampJump,
       "stamp_jump",
       "stamps jump by offset [s], forward or back",
       true,
       C::kBoth,
       {{"offset", 1.5}, {"start", 10}, {"duration", 0.5}}},
      {K::kClockOffset,
       "clock_offset",
       "the sensor's clock is off by offset [s] all the time",
       true,
       C::kLidar,
       {{"offset", 0.02}}},
      {K::kNan,
       "nan",
       "values are not-a-number in samples, or in this share of a scan's points",
       true,
       C::kBoth,
       {{"ratio", 0.02}, {"start", 0}, {"duration", kToTheEnd}}},
      {K::kEmptyScan,
       "empty_scan",
       "scans have no points",
       false,
       C::kLidar,
       {{"ratio", 1}, {"start", 10}, {"duration", 0.5}}},
      {K::kSparseScan,
       "sparse_scan",
       "scans have only a few points",
       false,
       C::kLidar,
       {{"points", 20}, {"start", 10}, {"duration", 0.5}}},
      {K::kDust,
       "dust",
       "dust returns echoes, density per metre of ray",
       false,
       C::kLidar,
       {{"density", 0.05}, {"start", 10}, {"duration", 5}}},
      {K::kWrongExtrinsic,
       "wrong_extrinsic",
       "config.yaml has a wrong extrinsic: the lidar is turned and moved by this",
       false,
       C::kLidar,
       {{"yaw_deg", 3}, {"pitch_deg", 0}, {"roll_deg", 0}, {"x", 0}, {"y", 0}, {"z", 0}}},
  };
}

// These faults are the IMU's own.
std::vector<KindText> ImuKinds() {
  using K = FaultKind;
  using C = FaultChannel;
  return {
      {K::kGyroSaturation,
       "gyro_saturation",
       "angular rates saturate at limit [rad/s]",
       false,
       C::kImu,
       {{"limit", 0.2}, {"start", 10}, {"duration", 5}}},
      {K::kShaking,
       "shaking",
       "the IMU is shaken: white noise of accel [m/s^2] and gyro [rad/s] a sample, 1 sigma",
       false,
       C::kImu,
       {{"accel", 0.3}, {"gyro", 0.005}, {"start", 10}, {"duration", kToTheEnd}}},
      {K::kImuDead,
       "imu_dead",
       "sensors of the IMU read zero: the gyro, the accelerometer, or with 1 for each both",
       false,
       C::kImu,
       {{"gyro", 1}, {"accel", 0}, {"start", 10}, {"duration", kToTheEnd}}},
      {K::kImuOffset,
       "imu_offset",
       "the rate about z is off by gyro [rad/s], the force along x by accel [m/s^2]",
       false,
       C::kImu,
       {{"gyro", 0.05}, {"accel", 0}, {"start", 10}, {"duration", kToTheEnd}}},
  };
}

const std::vector<KindText>& Kinds() {
  static const std::vector<KindText> kinds = [] {
    std::vector<KindText> all = DeliveryKinds();
    std::ranges::move(ContentKinds(), std::back_inserter(all));
    std::ranges::move(ImuKinds(), std::back_inserter(all));
    return all;
  }();
  return kinds;
}

std::string_view NameOf(FaultChannel channel) {
  constexpr std::array<std::string_view, 3> kNames = {"imu", "lidar", "both"};
  return kNames[static_cast<std::size_t>(channel)];
}

FaultChannel ParseChannel(const std::string& text) {
  for (const FaultChannel c : {FaultChannel::kImu, FaultChannel::kLidar, FaultChannel::kBoth}) {
    if (text == NameOf(c)) return c;
  }
  throw std::invalid_argument("fault channel '" + text + "' is none of imu, lidar, both");
}

const KindText& FindKind(const std::string& name) {
  std::string known;
  for (const KindText& kind : Kinds()) {
    if (kind.name == name) return kind;
    known.append(1, ' ').append(kind.name);
  }
  throw std::invalid_argument("no fault '" + name + "'; there are:" + known);
}

double ParseNumber(const std::string& key, const std::string& text) {
  std::size_t used = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !std::isfinite(value)) {
    throw std::invalid_argument("fault key '" + key + "' needs a number, not '" + text + "'");
  }
  return value;
}

void SetKey(Fault& fault, const KindText& kind, const std::string& item) {
  const std::size_t equals = item.find('=');
  const std::string key = item.substr(0, equals);
  if (equals == std::string::npos) {
    throw std::invalid_argument("fault part '" + item + "' is not of the form key=value");
  }
  const std::string text = item.substr(equals + 1);
  if (key == "channel" && kind.has_channel) {
    fault.channel = ParseChannel(text);
    return;
  }
  if (!fault.values.contains(key)) {
    std::string known = kind.has_channel ? " channel" : "";
    for (const auto& [name, value] : kind.keys) known += " " + name;
    throw std::invalid_argument("fault '" + std::string(kind.name) + "' has no key '" + key +
                                "'; it has:" + known);
  }
  fault.values[key] = ParseNumber(key, text);
}

}  // namespace

Fault ParseFault(const std::string& text) {
  const std::size_t colon = text.find(':');
  const KindText& kind = FindKind(text.substr(0, colon));
  Fault fault{kind.kind, kind.channel, {kind.keys.begin(), kind.keys.end()}};
  if (colon == std::string::npos) return fault;
  std::istringstream items(text.substr(colon + 1));
  for (std::string item; std::getline(items, item, ',');) SetKey(fault, kind, item);
  return fault;
}

std::string DescribeFaults() {
  std::ostringstream text;
  for (const KindText& kind : Kinds()) {
    text << "  " << kind.name << std::string(17 - kind.name.size(), ' ') << kind.meaning << "\n"
         << std::string(19, ' ');
    if (kind.has_channel) text << "channel=" << NameOf(kind.channel) << " ";
    for (const auto& [key, value] : kind.keys) {
      text << key << "=";
      if (value == kToTheEnd) {
        text << "(to the end) ";
      } else {
        text << value << " ";
      }
    }
    text << "\n";
  }
  return text.str();
}

}  // namespace lio::sim
