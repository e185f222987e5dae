// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/keyframe_policy.hpp"

namespace lio {
bool KeyframePolicy::HasMoved(const Pose& T_map_imu) const {
  const Pose motion = last_->Inverse() * T_map_imu;
  return motion.translation.norm() > kKeyframe.distance_m ||
         LogSo3(motion.rotation).norm() > kKeyframe.angle_rad;
}

bool KeyframePolicy::IsKeyframe(const Pose& T_map_imu) const {
  return !last_ || num_here_ < kKeyframe.max_scans_here || HasMoved(T_map_imu);
}

void KeyframePolicy::Accept(const Pose& T_map_imu) {
  if (last_ && !HasMoved(T_map_imu)) {
    ++num_here_;
    return;
  }
  last_ = T_map_imu;
  num_here_ = 1;
}

}  // namespace lio
