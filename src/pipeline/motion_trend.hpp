// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A motion model of second order for scans that no IMU helps: a body that has turned or moved
// farther than a constant velocity says is being accelerated, and the next prior will lag by about
// as much again.
#pragma once

#include "lio/base/pose.hpp"

namespace lio {

struct MotionTrendParameters {
  // This share of an error comes again. Chosen: a body seldom accelerates alike for two sweeps of
  // 0.1 s; all of it would overshoot by as much as none of it lags.
  double repeated_share = 0.7;
  // Errors of this size are half believed, since a prior errs by as much when nothing accelerates.
  // Chosen: ten times what matching errs by.
  double translation_noise_m = 0.1;
  double rotation_noise_rad = 0.02;
};
inline constexpr MotionTrendParameters kMotionTrend;

class MotionTrend {
 public:
  void Forget() { error_.setZero(); }
  // Takes the pose of a scan as a constant velocity predicted it, and as it was fused.
  void Add(const Pose& T_map_imu_predicted, const Pose& T_map_imu_fused) {
    error_ = LogSe3(T_map_imu_predicted.Inverse() * T_map_imu_fused);
  }
  const Vector6& error() const { return error_; }
  // Returns the error of the next prediction, a right increment [translation (m); rotation (rad)].
  [[nodiscard]] Vector6 Expected() const {
    Vector6 expected;
    expected << Believed(error_.head<3>(), kMotionTrend.translation_noise_m),
        Believed(error_.tail<3>(), kMotionTrend.rotation_noise_rad);
    return kMotionTrend.repeated_share * expected;
  }

 private:
  // Returns as much of it as is not noise: Wiener's filter with the error's own square for its
  // variance.
  static Vector3 Believed(const Vector3& error, double noise) {
    return error.squaredNorm() / (error.squaredNorm() + noise * noise) * error;
  }

  Vector6 error_ = Vector6::Zero();
};

}  // namespace lio
