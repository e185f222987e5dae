// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The YAML files beside the configuration: those of sensors, and the metadata of a ROS 2 bag.
#include <cstdlib>

#include "convert/firing_table.hpp"
#include "convert/rosbag2_files.hpp"
#include "fuzz/scratch_file.hpp"
#include "fuzz/target_helpers.hpp"
#include "fuzz/targets.hpp"
#include "lio/io/beam_table.hpp"
#include "lio/sim/imu_model.hpp"
#include "lio/sim/lidar_model.hpp"

namespace lio::fuzz {
namespace {

// The readers of config/lidars look into this folder for as long as it lives.
class OwnConfigFolder {
 public:
  OwnConfigFolder() { ::setenv("LIO_CONFIG_DIR", ScratchFolder().c_str(), 1); }
  ~OwnConfigFolder() { ::unsetenv("LIO_CONFIG_DIR"); }
  OwnConfigFolder(const OwnConfigFolder&) = delete;
  OwnConfigFolder& operator=(const OwnConfigFolder&) = delete;
};

}  // namespace

void SensorFile(ByteView bytes) {
  const std::filesystem::path file = ScratchFile("lidars/sensor.yaml", bytes);
  const OwnConfigFolder folder;
  MayRefuse([&] { (void)LoadBeamTable("sensor").NearestBeam(0.0); });
  MayRefuse([&] { (void)LoadFiringTable("sensor"); });
  MayRefuse([&] { (void)sim::LoadLidarModel(file); });
  MayRefuse([&] { (void)sim::LoadImuModel(file); });
}

void Rosbag2Metadata(ByteView bytes) {
  MayRefuse([&] { (void)FindRosbag2Files(ScratchFile("metadata.yaml", bytes)); });
}

}  // namespace lio::fuzz
