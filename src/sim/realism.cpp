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
      // Such gaps are as wide as those between a parked car and the wall behind it, in both
      // directions.
      {"mixed-pixels",
       [](RecordOptions& o) {
         o.lidar_errors.has_footprint = true;
         o.lidar_errors.in_between = {8.0f, 0.6};
       }},
      {"laser-bias", [](RecordOptions& o) { o.lidar_errors.laser_bias_std_m = 0.008; }},
      {"grazing-bias", [](RecordOptions& o) { o.lidar_errors.grazing_bias_m = 0.006; }},
      {"intensity-bias",
       [](RecordOptions& o) {
         o.lidar_errors.range_walk = {0.004, 0.05};
       }},
      {"glass", [](RecordOptions& o) { o.lidar_errors.has_glass = true; }},
      // The beam table errs by 0.02 deg.
      {"relief", [](RecordOptions& o) { o.lidar_errors.has_relief = true; }},
      {"beam-table", [](RecordOptions& o) { o.lidar_errors.beam_table_std_rad = 3.5e-4; }},
      // The speed varies by 0.1 %.
      {"rotor", [](RecordOptions& o) { o.lidar_errors.rotor.speed_std_ratio = 1e-3; }},
      // The encoder errs by 0.01 deg.
      {"encoder", [](RecordOptions& o) { o.lidar_errors.rotor.encoder_std_rad = 1.23e-4; }},
      {"stamp-jitter",
       [](RecordOptions& o) {
         o.clock_errors.imu_jitter_std_s = 2e-4;
         o.clock_errors.lidar_jitter_std_s = 1e-4;
       }},
      // The clock drifts by 20 ppm: 1.2 ms a minute.
      {"clock-drift", [](RecordOptions& o) { o.clock_errors.drift_std_ratio = 2e-5; }},
      {"vibration", [](RecordOptions& o) { o.imu_effects.vibrates = true; }},
      {"engine", [](RecordOptions& o) { o.imu_effects.has_engine = true; }},
      {"rectification", [](RecordOptions& o) { o.imu_effects.rectifies = true; }},
      {"g-sensitivity", [](RecordOptions& o) { o.imu_effects.is_g_sensitive = true; }},
      {"warm-up", [](RecordOptions& o) { o.imu_effects.warms_up = true; }},
  };
  return kEffects;
}

// Keeps what effects of the field ask of the model.
void MakeIdeal(InertialModel& model) {
  InertialModel ideal;
  ideal.vibration_std_per_mps = model.vibration_std_per_mps;
  ideal.bias_per_kelvin_std = model.bias_per_kelvin_std;
  ideal.bias_per_vibration_std = model.bias_per_vibration_std;
  ideal.bias_per_force_std = model.bias_per_force_std;
  model = ideal;
}

void MakeIdeal(RecordOptions& options) {
  options.lidar_errors.noise_scale = 0.0;
  options.lidar_errors.dropout_ratio = 0.0;
  options.lidar_errors.has_mixed_pixels = false;
  options.lidar_errors.has_weak_echoes = false;
  options.lidar.range_step_m = 0.0;
  options.claimed_imu = options.imu;  // users have data sheets, and no ideal ones
  MakeIdeal(options.imu.gyro);
  MakeIdeal(options.imu.accel);
}

bool Has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void CheckNames(const std::vector<std::string>& names) {
  const std::vector<std::string> known = FieldEffects();
  for (const std::string& name : names) {
    if (Has(known, name)) continue;
    std::string message("no effect '");
    message.append(name).append("'; there are:");
    for (const std::string& effect : known) message.append(" ").append(effect);
    throw std::invalid_argument(message);
  }
}

}  // namespace

std::vector<std::string> FieldEffects() {
  std::vector<std::string> names;
  for (const Effect& effect : Effects()) names.push_back(effect.name);
  return names;
}

void SetRealism(Realism realism, const EffectChoice& choice, RecordOptions& options) {
  CheckNames(choice.with);
  CheckNames(choice.without);
  if (realism == Realism::kIdeal) MakeIdeal(options);
  for (const Effect& effect : Effects()) {
    const bool belongs = realism == Realism::kField || Has(choice.with, effect.name);
    if (belongs && !Has(choice.without, effect.name)) effect.add(options);
  }
}

}  // namespace lio::sim
