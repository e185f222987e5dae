// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/unseen_motion.hpp"

#include <algorithm>

namespace lio {

bool IsMotionHidden(const std::vector<ImuSample>& samples) {
  return samples.empty() || !AreMeasured(samples);
}

UnseenMotion MotionByRigErrors(const RigBounds& bounds, const std::vector<ImuSample>& samples,
                               double speed_mps) {
  Vector3 turn = Vector3::Zero();  // sum of its size about each axis
  double max_rate_radps = 0.0;
  double span_s = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double dt_s = SecondsBetween(samples[i - 1].stamp, samples[i].stamp);
    turn += dt_s * samples[i].w_imu_radps.cwiseAbs();
    max_rate_radps = std::max(max_rate_radps, samples[i].w_imu_radps.norm());
    span_s += dt_s;
  }
  const Vector3& l = bounds.lever_m;
  const Vector3 shift(turn.y() * l.z() + turn.z() * l.y(), turn.z() * l.x() + turn.x() * l.z(),
                      turn.x() * l.y() + turn.y() * l.x());
  const double rotation_rad = bounds.rotation_rad.norm();
  return {shift.norm() + rotation_rad * speed_mps * span_s + bounds.offset_s * speed_mps,
          rotation_rad * turn.norm() + bounds.offset_s * max_rate_radps};
}

}  // namespace lio
