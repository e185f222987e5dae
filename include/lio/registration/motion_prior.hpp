// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A prior holds all that is known of a scan's pose before it is matched.
#pragma once

#include "lio/base/pose.hpp"

namespace lio {

struct MotionPrior {
  Pose T_map_imu;  // predicted, at the sweep's middle
  // Right error of T_map_imu, [translation (m); rotation (rad)]. It sets how far correspondences
  // and places are searched; it stays out of the cost.
  Matrix6 cov = Matrix6::Zero();
  // So much time has passed from the last scan that was located to this sweep's middle, during
  // which the prediction had nothing to correct it. It is positive.
  double since_last_fix_s = 0.1;
  double shift_std_m = 1.0;           // error of the predicted shift since the last located scan
  Vector3 up_map = Vector3::UnitZ();  // the vertical in the map, good to about 10 deg
};

}  // namespace lio
