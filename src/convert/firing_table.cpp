// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "firing_table.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "lio/io/beam_table.hpp"
#include "lio/io/input_error.hpp"

namespace lio {

FiringTable LoadFiringTable(const std::string& model) {
  constexpr double kSecondsPerMicrosecond = 1e-6;
  const BeamTable beams = LoadBeamTable(model);
  const std::string file = ConfigDirectory() / "lidars" / (model + ".yaml");
  FiringTable table;
  std::vector<double> times_us;
  try {
    const YAML::Node root = YAML::LoadFile(file);
    table.period_s = kSecondsPerMicrosecond * root["column_period_us"].as<double>();
    times_us = root["beams"]["fire_time_us"].as<std::vector<double>>();
  } catch (const YAML::Exception& error) {
    throw InputError(file + ": " + error.what());
  }
  if (times_us.size() != beams.elevation_rad.size() || !(table.period_s > 0.0)) {
    throw InputError(file + ": each beam must have its firing time, and the period be positive");
  }
  for (std::size_t ring = 0; ring < times_us.size(); ++ring) {
    table.channels.push_back({static_cast<std::uint16_t>(ring), beams.elevation_rad[ring],
                              beams.azimuth_offset_rad[ring],
                              kSecondsPerMicrosecond * times_us[ring]});
  }
  std::stable_sort(table.channels.begin(), table.channels.end(),
                   [](const auto& a, const auto& b) { return a.fire_time_s < b.fire_time_s; });
  return table;
}

}  // namespace lio
