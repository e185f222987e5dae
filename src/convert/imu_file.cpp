// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "imu_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>

#include "lio/base/stamp_limit.hpp"
#include "lio/convert/bag_reader.hpp"
#include "lio/convert/ros_messages.hpp"
#include "lio/io/event_log.hpp"
#include "lio/io/file_kind.hpp"
#include "lio/io/input_error.hpp"
#include "lio/io/stream_stats.hpp"
#include "lio/io/trajectory_file.hpp"
#include "ordered_log.hpp"
#include "plain_bag.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

void ReadLog(const fs::path& file, ImuFile& imu) {
  imu.description = "channel " + std::string(kImuChannel) + " of an LCM log";
  EventLogReader reader(file);
  LogEvent event;
  while (reader.Next(event)) {
    if (event.channel != kImuChannel) continue;
    ReceivedImu received{{}, ReceiveStamp(event.utime)};
    std::int32_t seq = 0;
    if (DecodeImu(event.data, received.sample, seq) == DecodeStatus::kOk) {
      imu.samples.push_back(received);
    } else {
      ++imu.num_damaged;
    }
  }
}

void ReadBag(const fs::path& file, ImuFile& imu) {
  const PlainBag plain(file);
  const auto bag = OpenBag(plain.path());
  bag->Select([](const BagTopic& topic) { return topic.type == "sensor_msgs/Imu"; });
  BagMessage message;
  std::string name;
  while (bag->Next(message)) {
    const BagTopic& topic = bag->topics()[message.topic];
    if (name.empty()) name = topic.name;
    if (topic.name != name) {
      throw UsageError(file.string() + ": has several IMUs, " + name + " and " + topic.name +
                       ": write one of them into a bag of its own");
    }
    const auto sample = DecodeRosImu(message.data, topic.encoding);
    if (sample) {
      imu.samples.push_back({*sample, message.received});
    } else {
      ++imu.num_damaged;
    }
  }
  imu.num_damaged += bag->damage().num_messages_damaged;
  imu.description = "topic " + name + " of a ROS bag";
}

std::vector<std::string_view> Cells(std::string_view line) {
  constexpr std::string_view kSeparators = ",; \t\r";
  std::vector<std::string_view> cells;
  while (!line.empty()) {
    const std::size_t begin = line.find_first_not_of(kSeparators);
    if (begin == std::string_view::npos) break;
    const std::size_t end = std::min(line.find_first_of(kSeparators, begin), line.size());
    cells.push_back(line.substr(begin, end - begin));
    line.remove_prefix(end);
  }
  return cells;
}

std::optional<Timestamp> StampOf(std::string_view cell) {
  constexpr std::int64_t kLeastNs = 100'000'000'000'000;
  std::int64_t whole = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), whole);
  const bool is_whole = error == std::errc() && end == cell.data() + cell.size();
  if (is_whole && whole > kLeastNs && whole <= kMaxStamp_ns) return Timestamp{whole};
  return ParseStamp(cell);
}

std::optional<ImuSample> SampleOf(std::string_view line) {
  const std::vector<std::string_view> cells = Cells(line);
  constexpr std::size_t kNumCells = 7;
  if (cells.size() < kNumCells) return std::nullopt;
  const auto stamp = StampOf(cells[0]);
  std::array<double, 6> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string_view cell = cells[i + 1];
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), values[i]);
    if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  }
  if (!stamp) return std::nullopt;
  return ImuSample{*stamp, {values[0], values[1], values[2]}, {values[3], values[4], values[5]}};
}

void ReadTable(const fs::path& file, ImuFile& imu) {
  imu.description = "a table";
  std::ifstream stream(file);
  std::string line;
  bool is_first = true;  // it may name the columns
  while (std::getline(stream, line)) {
    if (Cells(line).empty() || line.starts_with('#')) continue;
    const auto sample = SampleOf(line);
    if (sample) imu.samples.push_back({*sample, sample->stamp});
    if (!sample && !is_first) ++imu.num_damaged;
    is_first = false;
  }
}

}  // namespace

ImuFile ReadImuFile(const fs::path& file) {
  if (!fs::exists(file)) throw InputError(file.string() + ": no such file");
  RefuseIrregular(file);
  ImuFile imu;
  switch (KindOf(file)) {
    case FileKind::kLcmLog:
      ReadLog(file, imu);
      break;
    case FileKind::kRosBag:
      ReadBag(file, imu);
      break;
    default:
      ReadTable(file, imu);
  }
  if (imu.samples.empty()) {
    throw InputError(file.string() +
                     ": has no inertial samples: needed is an LCM log, a ROS bag, or a table of "
                     "stamp, wx, wy, wz, ax, ay, az");
  }
  std::stable_sort(imu.samples.begin(), imu.samples.end(),
                   [](const auto& a, const auto& b) { return a.received < b.received; });
  return imu;
}

}  // namespace lio
