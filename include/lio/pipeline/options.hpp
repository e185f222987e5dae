// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Every module's options in one value, and what is wrong with it.
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
  double rest_s = 1.0;               // a static start uses this much rest; at most 1.5
  double max_gyro_std_radps = 0.02;  // more spread than this is motion
  double max_accel_std_mps2 = 0.3;
  double moving_window_s = 2.0;  // a start in motion aligns this much of it; 1.5 to 3
  double wait_for_rest_s = 0.0;  // in motion, rest is awaited this long first
};

struct PipelineOptions {
  bool use_imu = true;  // false: lidar-only odometry by a constant-velocity guess
  MatchMethod method = MatchMethod::kNdt;
  int num_threads = 1;  // matching may use so many; results do not depend on it
  double incomplete_sweep_wait_s =
      0.05;                  // an incomplete sweep is closed when the IMU is this far on
  bool map_locked = false;   // the initial map stays as it is
  int max_queued_scans = 5;  // live only: more waiting scans than this, and the oldest is dropped
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

// One thing wrong with the options; `key` is the dotted path of the field, e.g. "ndt.voxel_m".
struct OptionFault {
  std::string key;
  std::string message;
};

// All faults at once; empty means usable.
std::vector<OptionFault> Validate(const Options& options);

}  // namespace lio
