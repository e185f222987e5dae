// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds the model of a lidar as its data file in config/lidars/ describes it: where each beam
// points, when it fires and how well it measures.
#pragma once

#include <array>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace lio::sim {

struct Beam {
  double elevation_rad = 0.0;
  double fire_time_s = 0.0;         // time after the column's instant
  double azimuth_offset_rad = 0.0;  // counter-clockwise from the column's heading
};

// Two prisms behind one another deflect the beams, each by the same angle and turning at a rate of
// its own (Risley), so that they draw a rosette about the middle of the view, as in Livox's sensors.
struct Rosette {
  std::array<double, 2> prism_hz{};
  double deflection_rad = 0.0;
};

struct LidarModel {
  std::string name;
  double rotation_hz = 10.0;  // clockwise seen from above
  double column_period_s = 46.08e-6;
  double cut_azimuth_rad = 0.0;  // heading at which one sweep ends and the next begins
  double view_rad = 2.0 * std::numbers::pi;  // width of what is reported, in azimuth
  double view_azimuth_rad = 0.0;             // its middle; a narrow view is mounted to face forward
  std::optional<Rosette> rosette;            // absent: a rotor turns the beams about z
  double min_range_m = 0.9;
  double max_range_m = 100.0;
  double range_std_m = 0.02;  // range noise at normal incidence
  double range_step_m = 0.002;
  double beam_width_horizontal_rad = 2.8e-3;
  double beam_width_vertical_rad = 1.4e-3;
  double range_at_10_percent_m =
      60.0;                 // half of the echoes of a matt 10 % target are lost at this range
  std::vector<Beam> beams;  // sorted from the lowest: the index is the ring
};

// `name_or_path` is a model of config/lidars/ or a file of that form. Throws std::runtime_error
// that says what is missing or wrong and lists the models.
[[nodiscard]] LidarModel LoadLidarModel(const std::string& name_or_path);

}  // namespace lio::sim
