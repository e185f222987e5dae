// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/sim/realism.hpp"

#include <algorithm>
#include <stdexcept>

namespace lio::sim {
namespace {

struct Effect {
  std::string name;
  void (*add)(RecordOptions&);
};

const std::vector<Effect>& Effects() {
  static const std::vector<Effect> kEffects = {
      // Gaps as wide as those between a parked car and the wall behind it, in both directions.
      {"mixed-pixels",
       [](RecordOptions& o) {
         o.lidar_errors.in_between_reach_m = 8.0f;
         o.lidar_errors.in_between_chance = 0.6;
         o.lidar_errors.straddles_rings = true;
       }},
      {"laser-bias", [](RecordOptions& o) { o.lidar_errors.laser_bias_std_m = 0.008; }},
      {"grazing-bias", [](RecordOptions& o) { o.lidar_errors.grazing_bias_m = 0.006; }},
      // 0.02 deg
      {"beam-table", [](RecordOptions& o) { o.lidar_errors.beam_table_std_rad = 3.5e-4; }},
      {"vibration", [](RecordOptions& o) { o.imu_vibrates = true; }},
  };
  return kEffects;
}

void MakeIdeal(RecordOptions& options) {
  options.lidar_errors.noise_scale = 0.0;
  options.lidar_errors.dropout_ratio = 0.0;
  options.lidar_errors.has_mixed_pixels = false;
  options.lidar_errors.has_weak_echoes = false;
  options.lidar.range_step_m = 0.0;
  const double rate_hz = options.imu.rate_hz;
  const std::string name = options.imu.name;
  options.imu = LoadImuModel("ideal");
  options.imu.rate_hz = rate_hz;
  options.imu.name = name;
}

}  // namespace

std::vector<std::string> FieldEffects() {
  std::vector<std::string> names;
  for (const Effect& effect : Effects()) names.push_back(effect.name);
  return names;
}

void SetRealism(Realism realism, const std::vector<std::string>& without, RecordOptions& options) {
  const std::vector<std::string> names = FieldEffects();
  for (const std::string& name : without) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    std::string message("no effect '");
    message.append(name).append("'; there are:");
    for (const std::string& effect : names) message.append(" ").append(effect);
    throw std::invalid_argument(message);
  }
  if (realism == Realism::kIdeal) MakeIdeal(options);
  if (realism != Realism::kField) return;
  for (const Effect& effect : Effects()) {
    if (std::find(without.begin(), without.end(), effect.name) == without.end()) {
      effect.add(options);
    }
  }
}

}  // namespace lio::sim
