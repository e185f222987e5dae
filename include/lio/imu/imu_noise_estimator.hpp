// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Learns the white noise of an IMU, per axis, from its samples: at rest that of its data sheet,
// in motion mostly vibration, which no data sheet knows.
//
// The sixth difference of neighbouring samples, 1 -6 15 -20 15 -6 1, keeps the upper third of the
// band and takes out the body's own motion: of an oscillation at a tenth of the sample rate (the
// hop of a wheel at 100 Hz) it leaves 0.06 per mille of the power. White noise of variance s^2
// gives it the variance 924 s^2, the sum of the squared factors, and a sample's variance times its
// step is the power spectral density. Fast sensors are averaged down to about 100 Hz first, so
// that the band looked at does not depend on the rate and lies below most sensors' own low-pass
// filters.
#pragma once

#include <array>
#include <cstddef>

#include "lio/sensor/imu_sample.hpp"

namespace lio {

struct ImuNoiseParameters {
  double window_s = 1.0;  // time constant of the mean: 30 degrees of freedom at 100 Hz
  double max_rate_hz = 100.0;
  // Differences across a longer step, as a multiple of the mean one, do not count: samples are
  // missing there.
  double max_step_ratio = 1.8;
};

inline constexpr ImuNoiseParameters kImuNoise;

class ImuNoiseEstimator {
 public:
  // Takes the next sample, in SI units, and writes what is known into it. Samples that are not
  // later than the last one get what is known and teach nothing.
  void Add(ImuSample& sample);
  // The next sample is no neighbour of the last one: its clock may be another. What is known stays.
  void Interrupt();

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;  // rate, force
  static constexpr std::size_t kOrder = 6;

  void AddToBlock(const ImuSample& sample);
  void AddBlock();
  void ForgetNeighbours();

  Vector6 psd_ = Vector6::Zero();
  double weight_ = 0.0;  // of the mean so far, below one
  double mean_step_s_ = 0.0;
  Timestamp last_;
  bool has_last_ = false;
  // The block of samples that is being averaged, and the last means, oldest first.
  Vector6 block_sum_ = Vector6::Zero();
  int num_in_block_ = 0;
  std::array<Vector6, kOrder + 1> blocks_;
  std::size_t num_blocks_ = 0;
};

}  // namespace lio
