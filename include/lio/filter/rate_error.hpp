// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Estimates the gyro's error in proportion to the rate: scale, misalignment, a wrong unit by per
// cents. It is no noise of the samples, and no bias, and at 300 deg/s the 0.5 % of a consumer unit
// are 2.6 mrad a scan, ten times what a match knows. Its size is learned from the poses: a turn by
// `turn_rad` since the last one leaves a residual r with |r|^2 = tr(S) + 3 s^2 turn^2, S the
// innovation's covariance without it and s the standard deviation of the ratio per axis. s^2 is the
// least-squares estimate over the turns, which large ones decide. A pose that is less sure than
// usual, as after a gap, weighs less by the square of its variance, which that of |r|^2 goes with.
#pragma once

#include "lio/base/rotation.hpp"

namespace lio {

struct RateErrorParameters {
  // Standard deviation of the ratio before the drive has shown it: industrial units have 0.05 to
  // 0.1 % by their data sheets (Xsens MTi-10: 0.05 %).
  double prior_std_ratio = 1e-3;
  // The prior weighs as one scan with this turn [rad]. Chosen: a scan at 170 deg/s and 10 Hz;
  // slower turns hardly show the error, nor suffer from it.
  double prior_turn_rad = 0.3;
  // So many turns of that size are remembered. Chosen: two seconds of them at 10 Hz.
  double num_turns_remembered = 20.0;
  // One pose weighs as so many of them at most. Chosen: half of what is remembered.
  double max_turns_a_pose = 10.0;
  // The usual variance of a residual is the least one lately, which may grow by this factor from
  // pose to pose, and that of a match [rad] at least. Chosen: a tenth of a second of doubt is
  // unusual, half a minute of it is not.
  double usual_growth = 1.02;
  double match_std_rad = 1e-3;
  // Upper bound of the ratio: uncalibrated consumer units have 3 % (InvenSense MPU-9250). A wrong
  // match counts for no more than it.
  double max_std_ratio = 0.05;
  // s. Poses have this interval before two have come: lidars turn at 10 Hz.
  double first_interval_s = 0.1;
};

class RateError {
 public:
  // The body turned at this rate for dt_s; from here on its noise counts.
  void Turn(double rate_radps, double dt_s);
  // A pose came. `residual_rad` is the rotation part of its residual; `cov` that of the
  // innovation's rotation, with what Turn() added to it.
  void AddPose(const Vector3& residual_rad, const Matrix3& cov);
  // Returns the same for a body whose turn so far no pose will tell of.
  [[nodiscard]] RateError Anew() const {
    RateError anew = *this;
    anew.turn_rad_ = anew.turn_time_s_ = anew.variance_rad2_ = 0.0;
    return anew;
  }
  // The pose was fused: what the body turns from here on shows at the next one.
  void BeginTurn();

  // Returns the ratio per axis.
  [[nodiscard]] double std_ratio() const;
  // Returns the power spectral density per axis [(rad/s)^2/Hz] whose white noise has the error's
  // variance at the next pose.
  [[nodiscard]] double Psd(double rate_radps) const;

 private:
  double turn_rad_ = 0.0;       // since the last fused pose
  double turn_time_s_ = 0.0;    // ... and how long it took
  double variance_rad2_ = 0.0;  // per axis, that the noise of Psd() has added since then
  double interval_s_ = RateErrorParameters{}.first_interval_s;  // between fused poses
  // The usual variance of a residual, per axis.
  double usual_var_rad2_ =
      RateErrorParameters{}.match_std_rad * RateErrorParameters{}.match_std_rad;
  double weight_sum_ = 0.0;   // turn^4 where it is as sure as usual
  double product_sum_ = 0.0;  // sum of the weights times the ratio's square
};

}  // namespace lio
