// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds the configuration keys `filter.*` of the error-state filter. The sensors' noise is in
// sensor/rig.hpp, constants without a key are in filter_parameters.hpp.
#pragma once

namespace lio {

struct FilterOptions {
  // s. How late a measurement may come and still be fused at its own time. Chosen: far above
  // the time of a match (docs/results.md), so that a busy machine's still count; more costs memory.
  double history_s = 3.0;
  // A pose is gated beyond this quantile of chi-square with 6 degrees of freedom. Customary.
  double gate_probability = 0.999;
  // After so many gated poses in a row the next is fused by force: the body has moved unseen.
  // Measured: docs/experiments/gated_in_a_row.md.
  int max_gated_in_a_row = 2;
  // Zero-velocity updates at rest (docs/filter.md, Zero-velocity update). Measured:
  // docs/experiments/zero_velocity.md.
  bool use_zero_velocity = true;
  // Estimates the clock offset between lidar and IMU (clock_offset.hpp). Measured:
  // docs/experiments/clock_offset.md.
  bool estimate_clock_offset = true;
  // Corrects rig.T_imu_lidar where the motion shows that it is surely wrong
  // (extrinsic_follower.hpp). Measured: docs/experiments/extrinsic.md.
  bool estimate_extrinsic = true;
  // The covariance of matches is scaled by this factor k; more trusts matches less. Measured on the
  // simulator: NIS per degree of freedom is 1.0 (docs/experiments/covariance_of_a_match.md).
  double registration_cov_scale = 1.6;
  // A map that grows from scans walks at random by this q, per share of new content. Measured on
  // the simulator: NEES of street and loop nearest to one (docs/experiments/map_walk.md).
  double map_walk_scale = 0.5;
};

}  // namespace lio
