// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds every module's options in one value, and tells what is wrong with it.
#pragma once

#include <string>
#include <vector>

#include "lio/filter/filter_options.hpp"
#include "lio/map/ndt_options.hpp"
#include "lio/registration/gicp_options.hpp"
#include "lio/registration/loam_options.hpp"
#include "lio/scan/loam_feature_options.hpp"
#include "lio/scan/reduce_options.hpp"
#include "lio/sensor/rig.hpp"

namespace lio {

enum class MatchMethod { kNdt, kLoam, kGicp };

struct StartOptions {
  // A static start uses this much rest; at most 1.5. Chosen: a second tells the accelerometer's
  // bias to what the body sways by (docs/experiments/zero_velocity.md); more delays the first pose.
  double rest_s = 1.0;
  // More spread than this is motion. Chosen: above engines at rest, below any ride.
  double max_gyro_std_radps = 0.02;
  double max_accel_std_mps2 = 0.3;
  // A start in motion aligns this much of it; 1.5 to 3. Measured: 2.5 and 3 s are no better
  // (docs/experiments/starts_in_motion.md).
  double moving_window_s = 2.0;
  double wait_for_rest_s = 0.0;  // in motion, rest is awaited this long first; chosen: not at all
};

struct PipelineOptions {
  // False: lidar-only odometry by a constant-velocity guess. Chosen: with an IMU less is lost.
  bool use_imu = true;
  // Measured: with the IMU NDT is the most exact in simulation (docs/results.md).
  MatchMethod method = MatchMethod::kNdt;
  int num_threads = 1;  // matching may use so many; results do not depend on it; chosen: few cores
  // An incomplete sweep is closed when the IMU is this far on. Chosen: half a sweep at 10 Hz; less
  // loses late chunks, more delays each scan with a lost one.
  double incomplete_sweep_wait_s = 0.05;
  bool map_locked = false;  // the initial map stays as it is; chosen: places change
  // Live, more waiting scans than this, and the oldest is dropped. Live and replayed alike, a clock
  // offset that is found moves the scans that come so many + 3 later: a live scan may wait so long
  // for its match. Chosen: half a second late at 10 Hz; more is old news to whoever steers by it.
  int max_queued_scans = 5;
  bool publish_features = false;  // live only, method loam only: each scan's edge and surface sets
};

struct Options {
  Rig rig;
  PipelineOptions pipeline;
  StartOptions start;
  ReduceOptions reduce;
  NdtOptions ndt;
  LoamFeatureOptions loam_features;
  LoamOptions loam;
  GicpOptions gicp;
  FilterOptions filter;
};

// Holds one thing wrong with the options; `key` is the dotted path of the field, e.g.
// "ndt.voxel_m".
struct OptionFault {
  std::string key;
  std::string message;
};

// All faults at once; empty means usable.
[[nodiscard]] std::vector<OptionFault> Validate(const Options& options);

}  // namespace lio
