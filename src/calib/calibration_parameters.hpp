// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tunes the calibration of clock offset and rotation between lidar and IMU (docs/calibration.md).
// Settings of a run are RotationCalibrationOptions. A comment gives the unit, the meaning and the
// source; a value marked "chosen" has no measurement behind it.
#pragma once

namespace lio {

// Tunes the poses by lidar-only odometry.
struct ScanPosesParameters {
  // s. A sweep that is still incomplete so long after a later chunk's stamp is closed. Chosen:
  // three sweeps at 10 Hz.
  double wait_s = 0.3;
  // m, rad. A pose along a known path is uncertain by this, 1 sigma. Chosen: some times what
  // matching errs by; more lets matching search farther.
  double path_std_m = 0.05;
  double path_std_rad = 0.005;
  // s. Matching is told this time since the last match at least. Chosen: a guard against division
  // by zero, a tenth of a sweep.
  double min_since_last_s = 0.01;
};

// Bounds the turns that are used.
struct TurnSelectionParameters {
  // A turn longer than this times the median spans a missing sweep. Arithmetic: half way between
  // one and two.
  double max_span_ratio = 1.5;
  // s. Samples are needed so far beyond a turn, because the least squares may move the offset.
  // Chosen: two steps of the search's grid.
  double offset_margin_s = 0.02;
};

// Tunes the search of the offset by correlation.
struct RateSearchParameters {
  // s. The grid over all offsets has this step, then the grid around the best. Chosen: turn rates
  // of hands and vehicles change little in 10 ms.
  double grid_step_s = 0.01;
  double fine_step_s = 0.001;
  // A correlation needs so many turns. Chosen: 2 s at 10 Hz; of fewer any two series are alike
  // somewhere.
  int min_turns = 20;
};

// Sets the requirements on the data, before the least squares.
struct CalibrationAcceptance {
  // Samples must cover so many turns: 5 s at 10 Hz. Chosen; docs/calibration.md asks for 30 s.
  int min_turns = 50;
  // rad/s. The root mean square of the turn rates must reach this. Chosen: less leaves the offset
  // undetermined.
  double min_rate_rms_radps = 0.02;
  // The correlation of the turn rates must reach this. Chosen: below it lidar and gyro did not
  // measure one motion (docs/calibration.md, How).
  double min_correlation = 0.6;
  // The second singular value of the rates must reach this share of the first. Chosen: below it all
  // turns are about one axis.
  double min_second_axis_ratio = 1e-3;
  // s. An offset so near to the limit of the search is refused. Arithmetic: half a step of the
  // grid.
  double limit_margin_s = 0.005;
};

// Tunes the least squares (src/calib/turn_fit.cpp).
struct TurnFitParameters {
  // The linearized least squares take so many rounds at most. Chosen: a bound on the time.
  int max_rounds = 8;
  // The noise is estimated in so many first rounds. Chosen: residuals of the first contain the
  // errors of the guess.
  int noise_rounds = 3;
  // s, rad. A smaller step has converged. Chosen: far below the standard deviations of a result,
  // 0.04 ms and 0.04 deg (docs/calibration.md, Figures).
  double converged_s = 1e-7;
  double converged_rad = 1e-7;
  // Ceres iterates so often at most in one round. Chosen: a bound on the time.
  int max_iterations = 20;
  // Sigmas. This is Huber's threshold. Customary: 3 sigma.
  double huber_sigmas = 3.0;
  // A residual larger than this times the median does not count in the estimate of the noise.
  // Chosen: of normal residuals less than one in a million is.
  double max_residual_ratio = 4.0;
  // rad. A sweep's rotation and a turn have this standard deviation at least. Chosen: below any
  // lidar's; it keeps the weights finite on exact data.
  double min_std_rad = 1e-5;
  // A turn's own standard deviation is at least this share of a sweep's. Chosen: with less the
  // problem is badly conditioned.
  double min_turn_share = 0.05;
};

struct CalibrationParameters {
  ScanPosesParameters scan_poses;
  TurnSelectionParameters turns;
  RateSearchParameters search;
  CalibrationAcceptance acceptance;
  TurnFitParameters fit;
};
inline constexpr CalibrationParameters kCalibrationParameters{};

}  // namespace lio
