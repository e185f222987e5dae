// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "rig_file.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "lio/io/beam_table.hpp"
#include "lio/io/output_file.hpp"

namespace lio::sim {
namespace {

constexpr double kLeastDensity = 1e-6;  // a filter cannot use the zero density of the ideal unit

// Returns the density of the random walk that grows like bias walk and Gauss-Markov process
// together over short times.
double WalkDensity(const InertialModel& model) {
  const double slow = model.bias_instability * std::sqrt(2.0 / model.bias_instability_time_s);
  return std::max(kLeastDensity, std::hypot(model.bias_walk_density, slow));
}

double BiasStd(const InertialModel& model) {
  return std::max(1e-5, std::hypot(model.turn_on_bias_std, model.bias_instability));
}

// Returns the model's name where liod has a table for it; generic for a data file of one's own.
std::string ModelInRig(const std::string& name) {
  const std::vector<std::string> models = LidarModels();
  return std::ranges::binary_search(models, name) ? name : "generic";
}

void WriteVector(std::ostream& file, const char* key, const Vector3& v) {
  file << key << ": [" << v.x() << ", " << v.y() << ", " << v.z() << "]\n";
}

}  // namespace

void WriteRigFile(const std::filesystem::path& path, const Scenario& scenario,
                  const RecordOptions& options) {
  std::ostringstream file;
  file.precision(9);
  const Pose T = ClaimedExtrinsic(options.faults, scenario.T_imu_lidar);
  file << "# Rig of lio-sim's scenario '" << scenario.name << "', seed " << options.seed << ": "
       << options.lidar.name << ", " << options.imu.name << ".\n"
       << "rig:\n  T_imu_lidar:  # p_imu = T_imu_lidar * p_lidar\n";
  WriteVector(file, "    translation_m", T.translation);
  file << "    rotation_wxyz: [" << T.rotation.w() << ", " << T.rotation.x() << ", "
       << T.rotation.y() << ", " << T.rotation.z() << "]\n"
       << "  lidar:\n    model: " << ModelInRig(options.lidar.name)
       << "\n    min_range_m: " << scenario.min_range_m
       << "\n    max_range_m: " << options.lidar.max_range_m << "\n";
  if (scenario.own_vehicle_box) {
    file << "    own_vehicle_box:\n";
    WriteVector(file, "      min_m", scenario.own_vehicle_box->min_m);
    WriteVector(file, "      max_m", scenario.own_vehicle_box->max_m);
  }
  const ImuModel& imu = options.claimed_imu ? *options.claimed_imu : options.imu;
  const InertialModel& gyro = imu.gyro;
  const InertialModel& accel = imu.accel;
  file << "  imu:\n"
       << "    gyro_noise_density: " << std::max(kLeastDensity, gyro.noise_density) << "\n"
       << "    accel_noise_density: " << std::max(kLeastDensity, accel.noise_density) << "\n"
       << "    gyro_bias_walk_density: " << WalkDensity(gyro) << "\n"
       << "    accel_bias_walk_density: " << WalkDensity(accel) << "\n"
       << "    gyro_bias_std_radps: " << BiasStd(gyro) << "\n"
       << "    accel_bias_std_mps2: " << BiasStd(accel) << "\n"
       << "    gravity: auto\n"
       << "  gravity_mps2: " << options.gravity_mps2 << "\n";
  WriteText(path, file.view());
}

}  // namespace lio::sim
