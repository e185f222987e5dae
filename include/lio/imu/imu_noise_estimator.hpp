// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Estimates the white noise of an IMU, per axis, from its samples: at rest that of its data sheet,
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

#include <span>

#include "lio/sensor/imu_noise.hpp"
#include "lio/sensor/imu_sample.hpp"

namespace lio {

struct ImuNoiseParameters {
  // s. An estimate looks at samples over this time. Chosen: 30 degrees of freedom at 100 Hz tell a
  // variance to a quarter; longer lags behind a road that changes.
  double window_s = 1.0;
  // Faster units are averaged down to this. Chosen: below most sensors' own low-pass filters.
  double max_rate_hz = 100.0;
  // Neighbours are this many mean steps apart. Beyond that samples are missing or made up. Chosen:
  // jitter of half a step passes, and a missing sample, two steps, does not.
  double min_step_ratio = 0.4;
  double max_step_ratio = 1.8;
};

inline constexpr ImuNoiseParameters kImuNoise;

// `samples` ascend, in SI units. Zero where fewer than seven neighbours tell; those that are
// saturated tell nothing.
[[nodiscard]] ImuNoise EstimateNoise(std::span<const ImuSample> samples);

}  // namespace lio
