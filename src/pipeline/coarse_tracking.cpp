// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/coarse_tracking.hpp"

#include <cmath>

#include "lio/imu/rest.hpp"
#include "pipeline/scan_step.hpp"

namespace lio {

Timestamp TrackStart(const Sweep& sweep, const MotionSeed& seed) {
  return seed.motion ? sweep.start : sweep.middle();
}

Vector3 MeanUp(std::span<const ImuSample> samples, const Rig& rig) {
  const Vector3 axis = rig.T_imu_lidar.value_or(Pose{}).rotation * Vector3::UnitZ();
  if (samples.empty()) return axis;
  const Vector3 up = Summarise(samples).mean_f_mps2.normalized();
  return std::abs(up.dot(axis)) > kCoarseTracking.min_up_cosine ? up : axis;
}

void FollowClockBack(const Sweep& sweep, ConstantVelocityTracker& tracker,
                     std::optional<Timestamp>& last_located) {
  if (sweep.end <= tracker.history().head().stamp) {
    tracker.SetClock(sweep.start);
    last_located = sweep.start;
  }
}

MatchJob MakeCoarseJob(const SweepPtr& sweep, const ConstantVelocityTracker& tracker,
                       std::optional<Timestamp> last_located, const Vector3& up_map) {
  MatchJob job = MakeTrackingJob(sweep, tracker.history(), last_located);
  job.prior.up_map = up_map;
  job.refines_deskew = true;
  std::get<Track>(job.task).holds_degenerate = true;
  return job;
}

}  // namespace lio
