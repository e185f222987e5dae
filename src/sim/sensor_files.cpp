// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads the data files of config/lidars/ and config/imus/.
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <stdexcept>

#include "lio/base/angle.hpp"
#include "lio/sim/data_file.hpp"
#include "lio/sim/imu_model.hpp"
#include "lio/sim/lidar_model.hpp"

namespace lio::sim {
namespace {

// Reads the values of one file; errors name the file and the key.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : name_(path.filename().string()) {
    try {
      root_ = YAML::LoadFile(path.string());
    } catch (const YAML::Exception& error) {
      throw std::runtime_error(name_ + ": " + error.what());
    }
  }

  template <typename T>
  T Get(const std::string& section, const std::string& key) const {
    const YAML::Node parent = section.empty() ? root_ : root_[section];
    const YAML::Node node = parent && parent.IsMap() ? parent[key] : YAML::Node();
    const std::string full = section.empty() ? key : section + "." + key;
    if (!parent || !node || node.IsNull()) {
      throw std::runtime_error(name_ + ": key '" + full + "' is missing");
    }
    try {
      return node.as<T>();
    } catch (const YAML::Exception&) {
      throw std::runtime_error(name_ + ": key '" + full + "' has a value of the wrong kind");
    }
  }
  double Number(const std::string& key) const { return Get<double>("", key); }
  bool Has(const std::string& section) const { return root_.IsMap() && root_[section]; }
  double NumberOr(const std::string& section, const std::string& key, double absent) const {
    const YAML::Node parent = section.empty() ? root_ : root_[section];
    return parent && parent.IsMap() && parent[key] ? Get<double>(section, key) : absent;
  }
  [[noreturn]] void Fail(const std::string& message) const {
    throw std::runtime_error(name_ + ": " + message);
  }

 private:
  std::string name_;
  YAML::Node root_;
};

InertialModel ReadInertial(const Reader& file, const std::string& section,
                           const std::string& unit) {
  const auto number = [&](const std::string& key) { return file.Get<double>(section, key); };
  InertialModel model;
  model.noise_density = number("noise_density");
  model.bias_walk_density = number("bias_walk_density");
  model.bias_instability = number("bias_instability_" + unit);
  model.bias_instability_time_s = number("bias_instability_time_s");
  model.turn_on_bias_std = number("turn_on_bias_std_" + unit);
  model.scale_std_ratio = number("scale_std_ratio");
  model.misalignment_std_rad = number("misalignment_std_rad");
  model.vibration_std_per_mps = number("vibration_std_" + unit + "_per_mps");
  model.bias_per_kelvin_std = file.NumberOr(section, "bias_std_" + unit + "_per_kelvin", 0.0);
  model.bias_per_vibration_std = file.NumberOr(section, "bias_std_" + unit + "_per_mps2_sq", 0.0);
  model.bias_per_force_std = file.NumberOr(section, "bias_std_" + unit + "_per_mps2", 0.0);
  model.full_scale = number("full_scale_" + unit);
  model.step = number("step_" + unit);
  return model;
}

}  // namespace

LidarModel LoadLidarModel(const std::string& name_or_path) {
  const Reader file(FindDataFile("lidars", name_or_path));
  LidarModel model;
  model.name = file.Get<std::string>("", "model");
  model.rotation_hz = file.Number("rotation_hz");
  model.column_period_s = 1e-6 * file.Number("column_period_us");
  model.cut_azimuth_rad = kRadPerDeg * file.Number("cut_azimuth_deg");
  model.min_range_m = file.Number("min_range_m");
  model.max_range_m = file.Number("max_range_m");
  model.range_std_m = file.Number("range_std_m");
  model.range_step_m = file.Number("range_step_m");
  model.beam_width_horizontal_rad = 1e-3 * file.Number("beam_width_horizontal_mrad");
  model.beam_width_vertical_rad = 1e-3 * file.Number("beam_width_vertical_mrad");
  model.range_at_10_percent_m = file.Number("range_at_10_percent_m");
  model.view_rad = kRadPerDeg * file.NumberOr("", "view_deg", 360.0);
  if (file.Has("rosette")) {
    const auto prism_hz = file.Get<std::vector<double>>("rosette", "prism_hz");
    if (prism_hz.size() != 2) file.Fail("'rosette.prism_hz' must have the rates of two prisms");
    model.rosette = Rosette{{prism_hz[0], prism_hz[1]},
                            kRadPerDeg * file.Get<double>("rosette", "deflection_deg")};
  }
  const auto elevation = file.Get<std::vector<double>>("beams", "elevation_deg");
  const auto fire_time = file.Get<std::vector<double>>("beams", "fire_time_us");
  const auto azimuth = file.Get<std::vector<double>>("beams", "azimuth_offset_deg");
  if (elevation.empty() || fire_time.size() != elevation.size() ||
      azimuth.size() != elevation.size()) {
    file.Fail("the three lists of 'beams' must have one entry per beam");
  }
  if (!std::is_sorted(elevation.begin(), elevation.end())) {
    file.Fail("'beams.elevation_deg' must ascend");
  }
  for (std::size_t i = 0; i < elevation.size(); ++i) {
    model.beams.push_back(
        {kRadPerDeg * elevation[i], 1e-6 * fire_time[i], kRadPerDeg * azimuth[i]});
  }
  return model;
}

ImuModel LoadImuModel(const std::string& name_or_path) {
  const Reader file(FindDataFile("imus", name_or_path));
  ImuModel model;
  model.name = file.Get<std::string>("", "model");
  model.rate_hz = file.Number("rate_hz");
  model.warm_up_kelvin = file.NumberOr("", "warm_up_kelvin", model.warm_up_kelvin);
  model.warm_up_time_s = file.NumberOr("", "warm_up_time_s", model.warm_up_time_s);
  model.gyro = ReadInertial(file, "gyro", "radps");
  model.accel = ReadInertial(file, "accel", "mps2");
  return model;
}

}  // namespace lio::sim
