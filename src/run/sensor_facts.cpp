// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "run/sensor_facts.hpp"

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

namespace lio {
namespace {

constexpr double kLook_s = 30.0;

}  // namespace

SensorFacts LookAtLog(const std::filesystem::path& log) {
  LogInputOptions options;
  options.duration_s = kLook_s;
  LogInput input(log, options);
  SensorFacts facts;
  RingElevations elevations;
  std::optional<std::int32_t> last_scan;
  while (const std::optional<InputItem> item = input.Next()) {
    const Timestamp received = ReceiveStamp(item->utime);
    if (const auto* sample = std::get_if<ImuSample>(&item->data)) {
      facts.imu.Add(sample->stamp, received);
      facts.accelerometer.Add(*sample);
      continue;
    }
    const auto& chunk = std::get<ScanChunk>(item->data);
    for (const LidarPoint& point : chunk.points) elevations.Add(point);
    if (last_scan != chunk.scan_seq) facts.lidar.Add(chunk.stamp, received);
    last_scan = chunk.scan_seq;
  }
  const std::vector<double> medians = elevations.Medians();
  facts.num_rings = static_cast<int>(medians.size());
  facts.guess = GuessLidar(medians, KnownLidars());
  return facts;
}

}  // namespace lio
