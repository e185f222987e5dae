// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// One inertial step: the nominal state and its covariance from one sample to the next.
//
// Integration: inertial_increment.hpp. Noise: continuous densities over dt, white acceleration
// giving the position-velocity cross terms dt^3/3, dt^2/2. Sources: Sola, arXiv 1711.02508,
// sections 4 and 5; Forster et al., TRO 2017; for the map pose docs/filter.md.
#pragma once

#include "lio/filter/nav_state.hpp"
#include "lio/sensor/imu_sample.hpp"

namespace lio {

// Continuous densities; see sensor/rig.hpp for units.
struct ProcessNoise {
  double gyro_density = 0.0;
  double accel_density = 0.0;
  double gyro_bias_walk_density = 0.0;
  double accel_bias_walk_density = 0.0;
};

NavState PropagateState(const NavState& state, const ImuSample& from, const ImuSample& to,
                        const Vector3& g_world);

// d(error at `to`) / d(error at `from`), along PropagateState. Dense form, for tests and reading.
ErrorMatrix TransitionMatrix(const NavState& before, const NavState& after, const ImuSample& from,
                             const ImuSample& to);

// Both at once. `from.stamp` is the estimate's stamp; needs to.stamp >= from.stamp.
void Propagate(Estimate& estimate, const ImuSample& from, const ImuSample& to,
               const ProcessNoise& noise, const Vector3& g_world);

// The body has moved in a way that the samples did not tell, by motion of the variances
// `motion_var_imu` [m^2; rad^2], and its velocity has changed by `velocity_var_imu` [(m/s)^2], all
// along the imu's axes. Both poses take the same motion; what is known of tilt and biases stays.
void AllowUnseenMotion(Estimate& estimate, const Vector6& motion_var_imu,
                       const Vector3& velocity_var_imu);

// The sample at `stamp` by linear interpolation, held beyond both ends.
ImuSample InterpolateSample(const ImuSample& a, const ImuSample& b, Timestamp stamp);

}  // namespace lio
