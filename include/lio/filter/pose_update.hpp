// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Measurement updates of the error-state filter: a pose from registration, a zero velocity, and a
// general linear measurement. State order, frames and units: nav_state.hpp.
//
// A pose measures Z = T_map_imu ExpSe3(n). The residual is r = LogSe3(T_map_imu^-1 Z); with a right
// error its Jacobian is -Jl^-1(r), and the noise n enters through Jr^-1(r). Joseph form; after
// injection the reset Jacobian transforms the covariance to the new nominal state (Sola,
// arXiv 1711.02508, section 6.3).
// After the scan is inserted, the map consists in part of this very scan: the error of the map pose
// shrinks by the share of new content, and that share's own error is added (docs/filter.md, After
// insertion). A match against what the scan before has just brought tells little of the motion
// since. Nothing throws; a measurement beyond the gate leaves the estimate as it is.
#pragma once

#include "lio/filter/nav_state.hpp"

namespace lio {

struct PoseMeasurement {
  Pose T_map_imu;
  Matrix6 cov = Matrix6::Zero();   // right error [m; rad]; large in degenerate directions
  double new_content_share = 0.0;  // 0..1, share of the matched map that this scan brings
  // The same along each direction, once the next match has told it (FilterHistory::AddPose); the
  // share above stands for it until then.
  bool knows_directions = false;
  Matrix6 share_by_direction = Matrix6::Zero();
  Matrix6 blend_cov = Matrix6::Zero();  // covariance added per share of new content
  bool is_level = false;                // the scan is inserted at LevelMapPose (map_bend.hpp)
};

struct UpdateResult {
  bool fused = false;            // false: gated, the estimate is unchanged
  double nis = 0.0;              // normalised innovation squared, 6 degrees of freedom
  double nis_translation = 0.0;  // the translation block alone, 3 degrees of freedom
  double nis_rotation = 0.0;     // the rotation block alone
};

// Fuses a pose unless its NIS exceeds `nis_limit` (infinity: always fuses).
[[nodiscard]] UpdateResult FusePose(Estimate& estimate, const PoseMeasurement& measurement,
                                    double nis_limit);

// Zero-velocity update: v_world_imu is zero with `variance` per axis, (m/s)^2, unless the NIS
// exceeds `nis_limit`. Only the result's fused and nis are set; nis has 3 degrees of freedom.
[[nodiscard]] UpdateResult FuseZeroVelocity(Estimate& estimate, double variance, double nis_limit);

// Blends the map pose after insertion. Call when the scan is inserted at the estimate's T_map_imu,
// or at LevelMapPose of it when measurement.is_level; the map pose then takes its share of the
// turn.
void BlendMapPose(Estimate& estimate, const PoseMeasurement& measurement);

// Returns the covariance of a match that counts only for what it is held by besides the last scan:
// cov (I - Phi)^-1, made symmetric. Phi: Observability::share_of_last_scan, eigenvalues below one.
[[nodiscard]] Matrix6 CovWithoutLastScan(const Matrix6& cov, const Matrix6& share_of_last_scan);

// Fuses a general linear measurement, for the initialization: residual = H error + noise of
// covariance `R`. `H` is n x kStateDim, `R` n x n, `residual` n. It uses the Joseph form, injection
// and reset, and never gates.
void FuseLinear(Estimate& estimate, const Eigen::MatrixXd& H, const Eigen::VectorXd& residual,
                const Eigen::MatrixXd& R);

}  // namespace lio
