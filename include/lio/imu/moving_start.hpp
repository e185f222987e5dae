// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Initializes in motion: it finds the filter's first state from poses by scan matching alone, over
// one and a half to three seconds, aligned with the inertial samples between them.
//
// Does: maximum a posteriori estimate of every pose and velocity of the window, of gravity's
// direction (two degrees of freedom; its length is the rig's) and of both biases, by least squares
// with Ceres. Terms: each matched pose (Huber loss, against a few wrong matches), the preintegrated
// inertial samples between neighbouring poses (Forster et al., TRO 2017), the biases' turn-on
// spread. Output: the state at `from`, with the covariance of the inverse Hessian, which includes
// the correlations of tilt, velocity and biases. Position and yaw are zero by definition: the map
// begins there. When the poses scatter more than their covariances say, the covariance is scaled by
// that. Failure: `start` is absent, and `why_not` names the data that are missing or do not agree.
// Throws std::invalid_argument without samples (Preintegrate). 20 poses at 200 Hz cost about 3 ms.
// Differs from Qin, Li, Shen, "VINS-Mono", TRO 2018, section V: scale is known, and poses and the
// accelerometer's bias are estimated, too. Constants: initialization_parameters.hpp.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lio/imu/matched_pose.hpp"
#include "lio/imu/start_state.hpp"

namespace lio {

struct MovingStart {
  std::optional<StartState> start;
  std::string why_not;
  // Scan matching and IMU agree by this measure: root of the median squared residual of the poses
  // over its expected value. It is about 1 when both are as their covariances say.
  double residual_ratio = 0.0;
};

// `samples` cover about `from` to the last pose; `from` is not after the first pose. Without
// `has_gravity` the measured force is taken as acceleration alone.
[[nodiscard]] MovingStart StartMoving(std::span<const ImuSample> samples,
                                      std::span<const MatchedPose> poses, Timestamp from,
                                      const Rig& rig, bool has_gravity);

}  // namespace lio
