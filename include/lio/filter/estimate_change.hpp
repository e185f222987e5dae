// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Changes an estimate at one instant, state and covariance together, where something other than a
// sample or a measurement tells of the motion. State order, frames and units: nav_state.hpp.
#pragma once

#include "lio/filter/nav_state.hpp"

namespace lio {

// Adds a motion that the samples did not show: of variance `motion_var_imu` [m^2; rad^2] to both
// poses alike, and `velocity_var_imu` [(m/s)^2] to the velocity, all along the imu's axes. The
// covariance of the biases stays as it is.
void AllowUnseenMotion(Estimate& estimate, const Vector6& motion_var_imu,
                       const Vector3& velocity_var_imu);

// Does the same with a motion of any covariance in imu.
void AddUnseenMotion(Estimate& estimate, const Matrix6& motion_cov_imu);

// Forgets the velocity for one that is known in imu, with `cov_world` besides: an error of the
// rotation turns it along.
void SetVelocity(const Vector3& v_imu_mps, const Matrix3& cov_world, Estimate& estimate);

// The biases become free of errors, and of correlations with all else.
void ForgetBiases(Estimate& estimate);

// Moves the body to where it is in map, as if both poses had been propagated by the exact increment
// D = T_map_imu_old^-1 T_map_imu; its velocity turns along. For a body whose place was lost, before
// its pose is fused: the residual is then zero, whatever the distance and the turn.
void MoveTo(const Pose& T_map_imu, Estimate& estimate);

}  // namespace lio
