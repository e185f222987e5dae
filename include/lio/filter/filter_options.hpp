// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The error-state filter's tuning; sensor noise is in the rig.
#pragma once

namespace lio {

struct FilterOptions {
  double history_s = 3.0;           // how late a measurement may come
  double gate_probability = 0.999;  // a pose farther off than this quantile is not fused
  int max_gated_in_a_row = 2;       // then it is fused all the same, as a motion that was not seen
  bool use_zero_velocity = true;    // false: a parked vehicle is a slow one
  bool estimate_clock_offset = false;   // between lidar and IMU, from turns
  double registration_cov_scale = 1.6;  // k of docs/filter.md; above 1 trusts matches less
  double map_walk_scale = 0.5;  // q of docs/filter.md: how far a map grown from scans drifts
};

}  // namespace lio
