// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// One inertial step: propagates the nominal state and its covariance from one sample to the next.
// State order, frames and units: nav_state.hpp.
//
// Integration: inertial_increment.hpp. Noise: continuous densities over dt; white acceleration
// noise gives the position and velocity terms dt^3/3, dt^2/2, dt. Sources: Sola, arXiv 1711.02508,
// sections 4 and 5; Forster et al., TRO 2017; for the map pose docs/filter.md.
#pragma once

#include "lio/filter/nav_state.hpp"
#include "lio/sensor/imu_noise.hpp"
#include "lio/sensor/imu_sample.hpp"

namespace lio {

// Holds continuous-time noise densities; ImuRig in sensor/rig.hpp has their units.
struct ProcessNoise {
  double gyro_density = 0.0;
  double accel_density = 0.0;
  double gyro_bias_walk_density = 0.0;
  double accel_bias_walk_density = 0.0;
  // The noise that the sensor shows; the densities above are its lower bounds.
  ImuNoise shown = {};
};

// Returns the power spectral densities that the filter counts on, per axis of imu.
Vector3 GyroPsd(const ProcessNoise& noise);
Vector3 AccelPsd(const ProcessNoise& noise);

NavState PropagateState(const NavState& state, const ImuSample& from, const ImuSample& to,
                        const Vector3& g_world);

// Propagates state and covariance. `from.stamp` is the estimate's stamp; needs to.stamp >=
// from.stamp.
void Propagate(Estimate& estimate, const ImuSample& from, const ImuSample& to,
               const ProcessNoise& noise, const Vector3& g_world);

// Returns the sample at `stamp` by linear interpolation, constant beyond both ends; saturated when
// either is.
ImuSample InterpolateSample(const ImuSample& a, const ImuSample& b, Timestamp stamp);

}  // namespace lio
