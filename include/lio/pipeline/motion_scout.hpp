// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Lidar-only odometry by a constant-velocity model, built from the filter itself: inertial samples
// that read nothing, no gravity, wide process noise. The gyro bias then is the negative turn rate.
// Serves lidar-only operation, and scouts the first second before the inertial filter starts.
#pragma once

#include "lio/filter/filter_history.hpp"

namespace lio {

class MotionScout {
 public:
  // Begins at rest at the origin with wide uncertainty of velocity and turn rate.
  MotionScout(Timestamp start, double span_s, double nis_limit);

  // Fills the time up to `stamp` with samples that read nothing.
  void AdvanceTo(Timestamp stamp);
  FilterHistory& history() { return history_; }
  const FilterHistory& history() const { return history_; }

  // True motion's turn rate in imu, rad/s.
  static Vector3 TurnRate(const NavState& state) { return -state.gyro_bias; }

 private:
  FilterHistory history_;
};

}  // namespace lio
