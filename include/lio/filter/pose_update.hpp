// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Fuses a registration into the filter: the pose of the imu in the map, Z = T_map_imu ExpSe3(n).
//
// Residual r = LogSe3(T_map_imu^-1 Z); with a right error its Jacobian is -Jl^-1(r), and the noise
// n enters through Jr^-1(r). Joseph form; after injection the covariance is carried over to the new
// nominal state by the reset Jacobian (Sola, arXiv 1711.02508, section 6.3).
// After the scan is inserted into the map, the map is partly a map of this very pose: the error of
// the map pose shrinks by the share of new content, and a fresh part comes in (docs/filter.md).
#pragma once

#include "lio/filter/nav_state.hpp"

namespace lio {

struct PoseMeasurement {
  Pose T_map_imu;
  Matrix6 cov = Matrix6::Zero();        // right error [m; rad], weak directions already large
  double new_content_share = 0.0;       // 0..1, of the map where the scan was matched
  Matrix6 blend_cov = Matrix6::Zero();  // covariance that the new content brings in, per share
};

struct UpdateResult {
  bool fused = false;            // false: gated, and the estimate is untouched
  double nis = 0.0;              // normalised innovation squared, 6 degrees of freedom
  double nis_translation = 0.0;  // of each half on its own, 3 degrees of freedom
  double nis_rotation = 0.0;
};

// Gates at `nis_limit` (infinity: never).
UpdateResult FusePose(Estimate& estimate, const PoseMeasurement& measurement, double nis_limit);

// Fuses a standstill: v_world_imu is zero but for noise of `variance` an axis, (m/s)^2. Gates at
// `nis_limit`; the result's nis has 3 degrees of freedom.
UpdateResult FuseStandstill(Estimate& estimate, double variance, double nis_limit);

// Call when the scan goes into the map at the estimate's T_map_imu.
void BlendMapPose(Estimate& estimate, const PoseMeasurement& measurement);

// From here on the map's frame is world itself, as for poses that are absolute: of motion capture,
// or of a surveyed map. T_map_imu becomes T_world_imu with its very error, so that FusePose
// measures both; nothing may be inserted or rebased then. The two stay equal to second order of the
// errors.
void MakeMapTheWorld(Estimate& estimate);

// General linear update with noise `R`, for start-up and pseudo-measurements: Joseph form,
// injection and reset. `H` has as many rows as `residual`.
void FuseLinear(Estimate& estimate, const Eigen::MatrixXd& H, const Eigen::VectorXd& residual,
                const Eigen::MatrixXd& R);

}  // namespace lio
