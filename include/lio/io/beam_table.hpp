// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// What the converters know about a lidar model: its beams, from config/lidars/MODEL.yaml.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lio {

struct BeamTable {
  std::string model;
  double rotation_hz = 10.0;               // as usually run
  bool clockwise = true;                   // seen from above
  std::vector<double> elevation_rad;       // above the lidar's xy plane, lowest beam first
  std::vector<double> azimuth_offset_rad;  // against the head's azimuth, counter-clockwise

  int num_beams() const { return static_cast<int>(elevation_rad.size()); }
  // The beam nearest in elevation.
  int NearestBeam(double elevation) const;
};

// Throws UsageError naming the known models when there is no such file, InputError naming file and
// fault when the file is no beam table.
BeamTable LoadBeamTable(const std::string& model);

// The table's elevations; none of model "generic". Throws as LoadBeamTable.
std::vector<double> BeamElevations(const std::string& model);

// Where configuration files live: the environment's LIO_CONFIG_DIR, else the folder beside the
// program (../../config, ../config, ../share/liod/config), else the source tree's.
std::filesystem::path ConfigDirectory();

}  // namespace lio
