// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The mean specific force over a second of rest, of a body that may sway meanwhile: in a hand, on
// legs, on swell. Each sample is turned by the gyro to the instant that the mean is asked for; a
// mean that is not turned is the tilt of half a second ago. The gyro's bias is not yet known and
// turns it, too, so that the mean's error and the bias belong together.
#pragma once

#include <span>

#include "lio/base/so3.hpp"
#include "lio/base/time.hpp"
#include "lio/sensor/imu_sample.hpp"

namespace lio {

struct RestForce {
  Vector3 mean_mps2 = Vector3::Zero();     // in imu at the instant asked for
  Matrix3 by_gyro_bias = Matrix3::Zero();  // its derivative
  double scatter_var = 0.0;                // (m/s^2)^2 per axis: its variance, by parts of the span
  Vector3 velocity_mps = Vector3::Zero();  // at the end, less its mean over the span; in imu then
};

// Returns it in imu at `stamp`, or at the end of the samples nearer to it. Throws
// std::invalid_argument without samples.
[[nodiscard]] RestForce MeanForceAtRest(std::span<const ImuSample> samples, Timestamp stamp,
                                        const Vector3& gyro_bias);

// Returns it of a body that does not turn, whatever the gyro's noise says.
[[nodiscard]] RestForce MeanForceUnturned(std::span<const ImuSample> samples, Timestamp stamp);

// Returns how far the body turned to and fro: the largest angle from the beginning on, without the
// mean rate [rad].
[[nodiscard]] double TurnToAndFro(std::span<const ImuSample> samples);

// Returns the spread of the forces about their mean, on the axis where it is largest [m/s^2], each
// turned by the gyro as it reads: what is left of a sway that turns gravity in the sensor.
[[nodiscard]] double SpreadOfTurnedForce(std::span<const ImuSample> samples);

}  // namespace lio
