// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tells how an error of the motion prior shows within a sweep: an error of a constant velocity has
// grown in proportion to the time since the last located scan, so that it moves the scan and bends
// it.
#pragma once

#include "lio/pipeline/match_job.hpp"

namespace lio {

// Returns the error of the pose at an instant of the sweep, as a share of that at its middle.
[[nodiscard]] inline double ShareOfPriorError(double from_mid_sweep_s, const MatchJob& job) {
  return 1.0 + from_mid_sweep_s / job.prior.since_last_fix_s;
}

// Returns the trajectory over the sweep, bent so that its middle is corrected by a right increment
// [translation (m); rotation (rad)].
[[nodiscard]] inline StampedPoses Bent(const MatchJob& job, const Vector6& correction) {
  StampedPoses bent = job.T_any_imu;
  for (StampedPose& pose : bent) {
    const double from_mid_sweep_s = SecondsBetween(job.sweep->middle(), pose.stamp);
    pose.pose = pose.pose * ExpSe3(ShareOfPriorError(from_mid_sweep_s, job) * correction);
  }
  return bent;
}

// Corrects what the job predicts, with such a correction.
inline void CorrectPrior(const Vector6& correction, MatchJob& job) {
  job.T_any_imu = Bent(job, correction);
  job.prior.T_map_imu = job.prior.T_map_imu * ExpSe3(correction);
}

}  // namespace lio
