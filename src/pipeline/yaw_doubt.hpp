// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The yaw of the world that a new map lies in, where the body turned unmeasured before it: no
// sensor ever tells that yaw, so its variance stands beside the filter (filter/world_yaw.hpp).
// Within an extended Kalman filter one that is unsure by a radian would become sure by mere
// linearisation (G. Huang, A. Mourikis, S. Roumeliotis, "Observability-based rules for designing
// consistent EKF SLAM estimators", IJRR 2010).
#pragma once

#include "lio/filter/published_estimate.hpp"

namespace lio {

class YawDoubt {
 public:
  // The world was turned about `pivot_world` (m) by an unknown angle of this variance (rad^2).
  void Add(double yaw_var, const Vector3& pivot_world) {
    const Vector3 moved = Vector3::UnitZ().cross(pivot_world);
    var_ += yaw_var;
    sum_ += yaw_var * moved;
    outer_ += yaw_var * moved * moved.transpose();
  }
  // Adds what the turns make of it to the covariance of an estimate. An angle a moves the position
  // p by a z x (p - pivot), and turns the pose and the velocity; the sum over all turns of the
  // squares is written out in the pivots.
  void AddTo(WorldEstimate& estimate) const {
    if (var_ <= 0.0) return;
    Eigen::Matrix<double, kAccelBias, 1> by_yaw = Eigen::Matrix<double, kAccelBias, 1>::Zero();
    by_yaw.segment<3>(kPos) = Vector3::UnitZ().cross(estimate.T_world_imu.translation);
    by_yaw.segment<3>(kRot) = estimate.T_world_imu.rotation.conjugate() * Vector3::UnitZ();
    by_yaw.segment<3>(kVel) = Vector3::UnitZ().cross(estimate.v_world_imu);
    estimate.cov += var_ * by_yaw * by_yaw.transpose();
    const Eigen::Matrix<double, kAccelBias, 3> cross = by_yaw * sum_.transpose();
    estimate.cov.middleCols<3>(kPos) -= cross;
    estimate.cov.middleRows<3>(kPos) -= cross.transpose();
    estimate.cov.block<3, 3>(kPos, kPos) += outer_;
  }

 private:
  double var_ = 0.0;                 // rad^2, of all turns together
  Vector3 sum_ = Vector3::Zero();    // sum of variance times z x pivot
  Matrix3 outer_ = Matrix3::Zero();  // sum of variance times its square
};

}  // namespace lio
