// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tunes the initialization, at rest (start_state.hpp) and in motion (moving_start.hpp). A comment
// gives the unit, the meaning and the source; a value marked "chosen" has no measurement behind it.
// The configuration keys are `start.*`.
#pragma once

#include <cstddef>

namespace lio {

// Tunes the initialization from samples at rest, and the continuation of an earlier path.
struct RestStartParameters {
  // m/s. A body at rest moves by this, 1 sigma. Chosen: above the 2.5 mm/s that a parked vehicle
  // sways by; 3 to 5 mm/s gained nothing (docs/experiments/zero_velocity.md).
  double velocity_std_mps = 0.01;
  // rad. Tilt is unknown by this before the mean force is fused, 1 sigma. Chosen: large against the
  // tilt that results.
  double unknown_tilt_std_rad = 1.0;
  // The gyro shows that the body turns to and fro if its angle leaves so many of its own noise's
  // standard deviations. Statistics: a walk that is tied at both ends has half a deviation in its
  // middle, so that 3 are never reached by noise alone.
  double min_turn_sigmas = 3.0;
  // m/s^2. Local gravity differs from the configured value by this, 1 sigma. Physics: 9.780 to
  // 9.832 m/s^2 from equator to poles.
  double gravity_std_mps2 = 0.02;
  // s. An earlier velocity is extrapolated no longer than this. Chosen: longer gaps say nothing
  // about the position anyhow; it bounds the jump after a clock step.
  double max_coast_s = 30.0;
  // The mean force counts as containing gravity from this share of g on. Arithmetic: half way
  // between none and all.
  double min_gravity_share = 0.5;
  // A path that a new initialization continues is uncertain by this at least, 1 sigma. Chosen:
  // without it the continued position would be stated to be exact; also the floor of a lidar-only
  // start anew.
  double continued_std_m = 0.5;
  double continued_std_rad = 0.05;
};

// Tunes the initialization in motion: what is required of the data, and of the solution.
struct MovingStartParameters {
  // A start needs so many matched scans, over so long a span (s). Chosen: less leaves tilt,
  // velocity and the accelerometer's bias undetermined; more delays the first pose.
  std::size_t min_poses = 8;
  double min_span_s = 1.0;
  // Scan matching errs by this beyond its own covariance, 1 sigma: scans deskewed by a constant
  // velocity, and a map that has only just begun. Chosen with the simulator's starts in motion
  // (docs/experiments/starts_in_motion.md).
  double pose_std_m = 0.02;
  double pose_std_rad = 0.003;
  // The root of the median normalized squared residual of the poses may reach this: 8 cm or 0.7 deg
  // of scatter at the values above. Chosen; more accepts worse extrinsics and clocks.
  double max_residual_ratio = 4.0;
  // rad. Roll and pitch may be uncertain by this, 1 sigma: 3 deg. Chosen: g times it is 0.5 m/s^2,
  // which the filter soon tells from acceleration; less delays starts on straight roads.
  double max_tilt_std_rad = 0.05;
  // A bias beyond this many of the rig's sigmas means wrong units, axes or gravity. Chosen: units
  // that are worse than their rig by a factor of two still start.
  double max_bias_sigmas = 6.0;
};

// Tunes the least squares behind it (src/imu/alignment.hpp).
struct AlignmentParameters {
  // Sigmas. Huber's threshold: the influence of a pose no longer grows beyond it. Statistics: 99 %
  // of normal errors in six dimensions are within 4.1.
  double huber_sigmas = 4.0;
  // The solver iterates so often at most. Chosen: 27 were needed where scans are weak along the
  // way; with 15, and a shorter velocity seed, two of 18 starts came late
  // (docs/experiments/starts_in_motion.md).
  int max_iterations = 60;
  // The iterations end when the cost changes by less than this share. Chosen: the cost is about
  // half a term each, so the step is far below one sigma.
  double function_tolerance = 1e-5;
};

struct InitializationParameters {
  RestStartParameters at_rest;
  MovingStartParameters in_motion;
  AlignmentParameters alignment;
};
inline constexpr InitializationParameters kInitializationParameters{};

}  // namespace lio
