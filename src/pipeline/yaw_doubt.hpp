// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The yaw of the world that a new map lies in, where the body turned unmeasured before it: no
// sensor ever tells that yaw, so its variance stands beside the filter. Within an extended Kalman
// filter a yaw that is unsure by a radian would become sure by mere linearisation (G. Huang,
// A. Mourikis, S. Roumeliotis, "Observability-based rules for designing consistent EKF SLAM
// estimators", IJRR 2010).
#pragma once

#include <algorithm>
#include <vector>

#include "lio/filter/published_estimate.hpp"

namespace lio {

class YawDoubt {
 public:
  // The world was turned about `pivot_world` (m) by an unknown angle of this variance (rad^2).
  void Add(double yaw_var, const Vector3& pivot_world) {
    if (yaw_var > 0.0) turns_.push_back({yaw_var, pivot_world});
  }
  // Adds what the turns make of it to the covariance of an estimate: an unknown angle moves the
  // position about its pivot, and turns the pose and the velocity.
  void AddTo(WorldEstimate& estimate) const {
    for (const Turn& turn : turns_) {
      Eigen::Matrix<double, kAccelBias, 1> by_yaw = Eigen::Matrix<double, kAccelBias, 1>::Zero();
      const Vector3 from_pivot = estimate.T_world_imu.translation - turn.pivot_world;
      by_yaw.segment<3>(kPos) = Vector3::UnitZ().cross(from_pivot);
      by_yaw.segment<3>(kRot) = estimate.T_world_imu.rotation.conjugate() * Vector3::UnitZ();
      by_yaw.segment<3>(kVel) = Vector3::UnitZ().cross(estimate.v_world_imu);
      estimate.cov += turn.var * by_yaw * by_yaw.transpose();
    }
  }

 private:
  struct Turn {
    double var = 0.0;  // rad^2
    Vector3 pivot_world;
  };
  std::vector<Turn> turns_;
};

}  // namespace lio
