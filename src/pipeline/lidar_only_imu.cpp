// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Lidar-only odometry watches an IMU that scans contradicted, until it follows them again.
#include <algorithm>

#include "pipeline/lidar_only.hpp"

namespace lio {

void LidarOnly::CompareWithImu(const MatchOutcome& outcome, bool is_fused) {
  if (!inertial_ || !imu_back_since_) return;  // no bias is known, or no samples come
  ImuDoubt& doubt = *handover_.imu_doubt;
  context_.stuck_imu.Add(context_.stream.imu().samples(), outcome.sweep->end);
  if (context_.stuck_imu.found()) doubt.last = outcome.sweep->end;
  if (!is_fused || outcome.is_relocalized) return imu_agreement_.Restart();
  const Timestamp middle = outcome.sweep->middle();
  const NavState& state = tracker_->history().At(middle).state;
  const NavState& before = inertial_->estimate.state;
  const ImuBuffer& imu = context_.stream.imu();
  const ImuAgreement::Belief belief = BeliefAbout(
      {before.gyro_bias, before.accel_bias}, imu.NoiseAt(outcome.sweep->end),
      state.T_map_imu.rotation * (state.T_world_imu.rotation.conjugate() * g_world_), context_);
  imu_agreement_.Add({middle, outcome.match.T_map_imu, outcome.match.cov}, imu, belief);
  if (imu_agreement_.Find(belief)) doubt.last = middle;
}

bool LidarOnly::FollowsAgain(Timestamp middle) const {
  const ImuDoubt& doubt = *handover_.imu_doubt;
  const int doublings = std::min(doubt.num_before, kLidarOnly.max_doublings);
  const double wait_s = kLidarOnly.doubts_imu_for_s * (1 << doublings);
  return SecondsBetween(doubt.last, middle) > wait_s &&
         imu_agreement_.HasShownAlike(doubt.contradiction, doubt.last);
}

}  // namespace lio
