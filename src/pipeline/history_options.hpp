// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The filter's options from the configuration.
#pragma once

#include "lio/filter/filter_history.hpp"
#include "lio/pipeline/options.hpp"

namespace lio {

inline HistoryOptions MakeHistoryOptions(const Options& options, double nis_limit,
                                         const Vector3& g_world, const ImuNoise& shown) {
  const ImuRig& imu = options.rig.imu;
  HistoryOptions history;
  history.noise = {imu.gyro_noise_density, imu.accel_noise_density, imu.gyro_bias_walk_density,
                   imu.accel_bias_walk_density, shown};
  history.g_world = g_world;
  history.span_s = options.filter.history_s;
  history.nis_limit = nis_limit;
  return history;
}

}  // namespace lio
