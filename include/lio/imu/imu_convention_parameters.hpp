// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tunes the detection of the IMU convention: units, axes and gravity of the inertial messages
// (imu_classifier.hpp, motion_evidence.hpp; docs/filter.md, Initialization). A comment gives the
// unit, the meaning and the source; a value marked "chosen" has no measurement behind it. The
// standard deviations and thresholds were found together on simulated drives (g, deg/s, both, z
// down, turned axes); KITTI 0005 and UrbanLoco drives, whose convention is the expected one, are
// decided rightly, too.
#pragma once

#include <cstddef>

namespace lio {

// Tunes which poses and samples are kept, and how well they agree under the right convention.
struct MotionEvidenceParameters {
  // So many steps are kept: 10 s at 10 Hz. Chosen; more costs time and takes longer to forget.
  std::size_t max_steps = 100;
  // So many last steps tell whether the body moves now. Chosen: a second at 10 Hz.
  int recent_steps = 10;
  // m, rad. The body counts as moving from this motion over these steps on. Chosen: 0.3 m/s
  // and 0.1 rad/s at 10 Hz, beyond what matching errs by at rest.
  double min_motion_m = 0.3;
  double min_motion_rad = 0.1;
  // rad. A step's turn errs by this, 1 sigma, by skewed scans and by maps during warm-up. Fitted to
  // the simulator's drives of docs/experiments/imu_convention.md.
  double turn_std_rad = 0.003;
  // rad/s. The gyro bias may be this before anything is known, 1 sigma. Chosen: 3 deg/s, the
  // turn-on bias of the worst units.
  double gyro_bias_std_radps = 0.05;
  // s. The positions of a second difference are so far apart in time. Chosen: longer averages
  // noise, shorter sees livelier motion, such as a walker's step.
  double second_difference_span_s = 0.5;
  // This share of that time must exist on either side. Chosen: a sweep of 0.1 s may be missing.
  double min_span_share = 0.8;
  // m/s^2. A second difference errs by this, 1 sigma: 1 cm in each position at 0.5 s. Fitted to the
  // same drives.
  double second_difference_std_mps2 = 0.15;
  // m/s^2. The mean force's length errs by this in one map, 1 sigma: the accelerometer's bias.
  // Chosen for consumer units.
  double gravity_std_mps2 = 0.15;
  // A rate is a spike when it is beyond any gyro and this many times the median of its step.
  // Chosen: no turn triples within a sweep; a smaller one takes lively rates in deg/s for spikes.
  double spike_ratio = 3.0;
};

// Bounds the decisions. Scores are chi-square, scaled so that the best convention fits.
struct ImuClassifierParameters {
  // So many steps are needed before anything is decided. Chosen: 0.8 s at 10 Hz.
  std::size_t min_steps = 8;
  // A convention worse than the best by this is refuted. Chosen: 5.5 sigma of one degree of
  // freedom, for scores whose errors are not independent.
  double refuted_score = 30.0;
  // The expected convention is given up only when worse than the best by this. Chosen: twice the
  // above, since a wrong change costs more than a late one.
  double given_up_score = 60.0;
  // Another convention fits better when it is better by this. Measured: scans that hold to the
  // rings of a standstill favour none (motorway, seed 12; docs/filter.md).
  double favoured_score = 1.0;
  // A quarter turn of the vertical that the rig does not state has this score. Chosen: lidars
  // mostly stand upright; below refuted_score, so that motion can overrule it.
  double lean_score = 20.0;
  // The best convention's score may be scaled by this; beyond it nothing is decided. Chosen: 3
  // sigma.
  double max_residual_ratio_sq = 9.0;
  // rad and ratio. A step's turn by the gyro that is larger than both, against scan matching, is
  // absurd. Chosen: deg/s taken for rad/s is 57 times too large.
  double absurd_turn_rad = 0.03;
  double absurd_ratio = 5.0;
  // Steps. The expected convention is tried under this clock offset, too. Chosen: two sweeps.
  double max_clock_shift_steps = 2.0;
  double clock_shift_grid_steps = 0.5;  // their grid; chosen: turns change little within
  // Share. A mean force at rest within this of 1 g (in either unit) tells the unit. Chosen: bias
  // and scale of poor units, vibration.
  double force_tolerance = 0.25;
  // g. A mean force at rest below this contains no gravity. Arithmetic: half way between
  // 0 and 1.
  double max_force_without_gravity = 0.5;
  // rad/s. Rates noisier than this may be in deg/s. Chosen: above what engines and hands cause at
  // rest.
  double min_noise_radps = 0.1;
  // The samples, when taken as deg/s, must have this share of the rig's gyro noise. Chosen: rigs
  // claim about twice the data sheet (sensor/rig.hpp), so that half is left, less some margin.
  double min_noise_share = 0.4;
};

struct ImuConventionParameters {
  // rad/s (5730 deg/s). No gyro measures more: data sheets of MEMS units end at 2000 to 4000 deg/s.
  double max_gyro_rate_radps = 100.0;
  MotionEvidenceParameters evidence;
  ImuClassifierParameters classifier;
};
inline constexpr ImuConventionParameters kImuConventionParameters{};

}  // namespace lio
