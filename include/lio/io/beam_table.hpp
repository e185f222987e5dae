// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Describes a lidar model for the converters: its beams, read from config/lidars/MODEL.yaml.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lio {

struct BeamTable {
  std::string model;
  double rotation_hz = 10.0;               // usual rate of rotation
  bool clockwise = true;                   // seen from above
  std::vector<double> elevation_rad;       // above the lidar's xy plane, lowest beam first
  std::vector<double> azimuth_offset_rad;  // relative to the head's azimuth, counter-clockwise

  [[nodiscard]] int num_beams() const { return static_cast<int>(elevation_rad.size()); }
  // Returns the beam nearest in elevation.
  [[nodiscard]] int NearestBeam(double elevation) const;
};

// Returns the names of the models that have a table, sorted.
[[nodiscard]] std::vector<std::string> LidarModels();

// Throws UsageError that lists the known models when there is no such file, and InputError that
// names the file and the fault when the file is no beam table.
[[nodiscard]] BeamTable LoadBeamTable(const std::string& model);

// Returns the table's elevations; for model "generic" the list is empty. Throws as LoadBeamTable.
[[nodiscard]] std::vector<double> BeamElevations(const std::string& model);

// Returns the folder of the configuration files: the environment's LIO_CONFIG_DIR, else that in a
// wheel of the Python package, else the folder beside the program (../../config, ../config,
// ../share/liod/config), else the source tree's.
[[nodiscard]] std::filesystem::path ConfigDirectory();

}  // namespace lio
