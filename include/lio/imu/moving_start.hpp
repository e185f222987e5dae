// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The filter's first state while the vehicle moves: poses from scan matching alone, over one and a
// half to three seconds, aligned with the inertial samples between them.
//
// Does: maximum a posteriori for every pose and velocity of the window, gravity's direction (two
// degrees of freedom, its length is the rig's) and both biases, by least squares with Ceres.
// Terms: each matched pose (Huber, so that a few wrong matches do no harm), the preintegrated
// inertial samples between neighbouring poses, the biases' turn-on spread.
// Output: the state at `from`, with the covariance of the inverse Hessian, correlations of tilt,
// velocity and biases included; position and yaw are zero by definition, the map starts there.
// When matching scatters more than its covariances say, all is widened by that.
// Failure: `start` is absent and `why_not` says what is missing or does not fit.
// Cost: about 3 ms for 20 poses at 200 Hz.
// Differs from Qin, Li, Shen, "VINS-Mono", TRO 2018, section V: scale is known, poses are estimated
// too, and the accelerometer's bias with them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lio/imu/start_state.hpp"

namespace lio {

// A pose from scan matching, in any frame that does not move.
struct MatchedPose {
  Timestamp stamp;
  Pose T_any_imu;
  Matrix6 cov = Matrix6::Zero();  // right error [m; rad], as scan matching gives it
};

struct MovingStart {
  std::optional<StartState> start;
  std::string why_not;
  // How well scan matching and the inertial unit agree: weighted residual of the poses over its
  // expectation, as a standard deviation. About 1 when all is well.
  double misfit = 0.0;
};

// `samples` reach from about `from` to the last pose; `from` is not after the first pose. Without
// `has_gravity` the accelerometer's reading is taken as acceleration alone.
MovingStart StartMoving(std::span<const ImuSample> samples, std::span<const MatchedPose> poses,
                        Timestamp from, const Rig& rig, bool has_gravity);

}  // namespace lio
