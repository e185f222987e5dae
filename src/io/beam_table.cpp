// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/beam_table.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "lio/base/angle.hpp"
#include "lio/io/input_error.hpp"

namespace lio {
namespace {

namespace fs = std::filesystem;

std::vector<double> Radians(const YAML::Node& degrees) {
  auto values = degrees.as<std::vector<double>>();
  for (double& value : values) value *= kRadPerDeg;
  return values;
}

// Returns the folder of the Python module, where this code is in one. A program may have been
// called by a relative name, which would mean another folder by now: then there is nothing.
std::optional<fs::path> FolderOfModule() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&Radians), &info) == 0) return std::nullopt;
  const fs::path file = info.dli_fname == nullptr ? "" : info.dli_fname;
  if (!file.is_absolute()) return std::nullopt;
  return file.parent_path();
}

}  // namespace

int BeamTable::NearestBeam(double elevation) const {
  const auto above = std::lower_bound(elevation_rad.begin(), elevation_rad.end(), elevation);
  if (above == elevation_rad.begin()) return 0;
  if (above == elevation_rad.end()) return num_beams() - 1;
  const bool nearer_above = *above - elevation < elevation - *(above - 1);
  return static_cast<int>(above - elevation_rad.begin()) - (nearer_above ? 0 : 1);
}

std::vector<std::string> LidarModels() {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(ConfigDirectory() / "lidars", ignored)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

BeamTable LoadBeamTable(const std::string& model) {
  const fs::path path = ConfigDirectory() / "lidars" / (model + ".yaml");
  if (model.find('/') != std::string::npos || !fs::exists(path)) {
    throw UsageError(fmt::format("no lidar model '{}': known are generic, {}", model,
                                 fmt::join(LidarModels(), ", ")));
  }
  BeamTable table;
  table.model = model;
  try {
    const YAML::Node root = YAML::LoadFile(path.string());
    table.rotation_hz = root["rotation_hz"].as<double>();
    table.elevation_rad = Radians(root["beams"]["elevation_deg"]);
    table.azimuth_offset_rad = Radians(root["beams"]["azimuth_offset_deg"]);
  } catch (const YAML::Exception& error) {
    throw InputError(path.string() + ": " + error.what());
  }
  const bool sorted = std::is_sorted(table.elevation_rad.begin(), table.elevation_rad.end());
  if (table.elevation_rad.empty() || !sorted ||
      table.azimuth_offset_rad.size() != table.elevation_rad.size()) {
    throw InputError(path.string() + ": beams must be listed lowest first, each with its offset");
  }
  return table;
}

fs::path ConfigDirectory() {
  if (const char* given = std::getenv("LIO_CONFIG_DIR")) return given;
  std::error_code error;
  if (const std::optional<fs::path> folder = FolderOfModule()) {
    if (fs::is_directory(*folder / "config/lidars", error)) return *folder / "config";
  }
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  for (const char* relative : {"../../config", "../config", "../share/liod/config"}) {
    const fs::path candidate = (program.parent_path() / relative).lexically_normal();
    if (!error && fs::is_directory(candidate / "lidars")) return candidate;
  }
  return LIO_SOURCE_CONFIG_DIR;
}

std::vector<double> BeamElevations(const std::string& model) {
  return model == "generic" ? std::vector<double>{} : LoadBeamTable(model).elevation_rad;
}

}  // namespace lio
