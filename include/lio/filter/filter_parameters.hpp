// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds the filter's tuning constants: those that no configuration key holds. Keys are in
// filter_options.hpp, the noise of the sensors is in sensor/rig.hpp, and what one FilterHistory may
// be given otherwise is HistoryOptions. A comment gives the unit, the meaning and the source; a
// value marked "chosen" has no measurement behind it.
#pragma once

#include <cstddef>

#include "lio/sensor/gap.hpp"

namespace lio {

// Tunes the NIS-based covariance inflation of poses from registration (docs/filter.md, Pose
// update).
struct InflationParameters {
  // A new NIS has this share in the factor. Chosen: ten poses, one second at 10 Hz; more follows
  // faster and is noisier.
  double rate_per_pose = 0.1;
  // A larger NIS (3 degrees of freedom) counts as this. Chosen: a wrong match alone multiplies the
  // factor by 4.2 at most.
  double max_nis = 100.0;
  // The covariance grows by this factor at most. Measured on 32 drives of the simulator with 1, 3
  // and 9; without a cap the filter diverged on EuRoC V1_01 (docs/experiments/nis_inflation.md).
  double max_factor = 9.0;
};

// Tells how a pose beyond the gate is fused when it must be (docs/filter.md, Pose update).
struct ForcedUpdateParameters {
  // m, rad. Smaller residuals are registration errors: the pose's covariance is multiplied by the
  // residual's NIS over the gate's limit. Larger ones are motion that no sample showed, or a wrong
  // match. Chosen on drives of the simulator, where a map of parked scans pulls by centimetres.
  double max_registration_error_m = 0.15;
  double max_registration_error_rad = 0.03;
  // s. Unseen motion is taken to have lasted this long, which gives its velocity. Chosen: one or
  // two sweeps at 10 Hz; longer trusts the old velocity more.
  double unseen_motion_s = 0.2;
};

// Tells the process noise that is added where inertial samples are missing or saturated.
struct ImuOutageParameters {
  // Samples that are farther apart have a gap between them: as sensor/gap.hpp defines it.
  Duration gap = kImuGap.sparse;
  // Acceleration (m/s^2) and rate (rad/s) are unknown by this in a gap, 1 sigma, as for a walking
  // person. Found on 24 simulated walks, with StreamParameters::mean_before_gap_s
  // (docs/experiments/imu_gaps.md).
  double gap_accel_std_mps2 = 3.0;
  double gap_gyro_std_radps = 0.5;
  // s. The error of a saturated sample lasts this long. Chosen: one sweep at 10 Hz, after which a
  // scan tells.
  double saturated_s = 0.1;
  // Acceleration (m/s^2) and rate (rad/s) lie this far beyond the end of the range, 1 sigma. The
  // rate is measured: drives with clipped gyros keep their path, and a sports hall with 2 rad/s
  // beyond the range is lost (docs/experiments/gyro_saturation.md). The acceleration is chosen: 1
  // g.
  double saturated_accel_std_mps2 = 10.0;
  double saturated_gyro_std_radps = 2.0;
};

// Tunes the estimator of the clock offset between lidar and IMU (docs/filter.md, Clock offset).
struct ClockOffsetParameters {
  // s. The estimate stays within this of zero. Chosen: a sweep at 10 Hz, as where sweeps are
  // stamped at their end, and a fifth more; lio-log calibrate finds larger offsets.
  double max_offset_s = 0.12;
  // s. A rate is a mean over this time around a stamp. Chosen: twice max_std_s, so that the stamp
  // lies within it as it should be.
  double rate_span_s = 0.04;
  // rad/s. Turns whose rate changes less are left out. Chosen above the sway of a car's body on a
  // straight road; rates of single samples needed 0.05 (docs/experiments/clock_offset.md).
  double min_rate_change_radps = 0.02;
  // The change must also exceed so many of its standard deviations. Statistics: noise of the rate
  // makes the estimate too small by 1/(1 + sigmas^2), here 3 %.
  double min_rate_change_sigmas = 6.0;
  // rad. A turn errs by this beyond what registration and gyro claim, 1 sigma, before the drive has
  // shown it. Chosen; it matters for the first seconds.
  double turn_std_rad = 1e-3;
  // This error is learned over so many turns. Chosen: five seconds at 10 Hz.
  double num_turns_remembered = 50.0;
  // A single turn counts for no more than so many times the variance. Chosen: three sigmas.
  double max_scatter_ratio = 9.0;
  // s per second. The offset drifts by this, 1 sigma. Physics: crystals that run free keep to 20
  // parts in a million, so say their data sheets.
  double rate_std = 2e-5;
  // s/sqrt(s). Besides, the offset walks at random by this. Chosen: a crystal's rate changes by
  // about a part in a million over a minute, as it warms.
  double walk_s_per_sqrt_s = 1e-5;
  // s. Scans that are farther apart have stamps of clocks that were set. Chosen: a drift of 20
  // parts in a million is 12 ms by then, about as unsure as at the start.
  double max_span_s = 600.0;
  // s. The standard deviation starts at this value, its upper bound. Chosen: a driver's latency; 48
  // ms give the same paths to a tenth (docs/experiments/clock_offset.md).
  double max_std_s = 0.02;
  // s. Below this standard deviation the stamps are moved. Chosen: an offset of 2 ms turns a scan
  // by 2 mrad at 1 rad/s.
  double known_std_s = 2e-3;
  // Standard deviations. The stamps are moved before that where they are off for sure. Statistics:
  // without an offset one estimate in 370 of a normal distribution lies so far from zero.
  double sure_sigmas = 3.0;
  // Stamps are moved after so many turns. Chosen: one wrong match, or two, do not show an offset.
  int min_turns = 5;
  // s per scan. The correction changes by this at most. Chosen: it turns a scan by 2 mrad at 1
  // rad/s (tested by ClockOffset.StampsAreMovedSlowly).
  double max_step_s = 2e-3;
  // s. An offset is announced that is known so well (one standard deviation), and so large that it
  // matters. Chosen: 1 cm at 10 m/s, and three standard deviations of it.
  double announced_std_s = 1e-3;
  double min_announced_s = 3e-3;
};

// Bounds the window of events (filter_history.hpp).
struct HistoryParameters {
  // Events that are kept at most, where stamps hardly advance. Chosen: three seconds of a 10 kHz
  // IMU.
  std::size_t max_events = 1 << 15;
};

struct FilterParameters {
  HistoryParameters history;
  InflationParameters inflation;
  ForcedUpdateParameters forced_update;
  ImuOutageParameters imu_outage;
  ClockOffsetParameters clock_offset;
};
inline constexpr FilterParameters kFilterParameters{};

}  // namespace lio
