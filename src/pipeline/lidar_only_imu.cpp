// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Lidar-only odometry watches an IMU that scans contradicted, until it follows them again. Its gyro
// is used where the accelerometer alone was contradicted.
#include <algorithm>
#include <cmath>
#include <deque>

#include "lio/filter/sample_lookup.hpp"
#include "pipeline/lidar_only.hpp"

namespace lio {

void LidarOnly::AddRates(Timestamp end) {
  const Timestamp from = tracker_->history().head().stamp;
  for (const ImuSample& sample : context_.stream.imu().Between(from, end)) {
    tracker_->AddRate(sample);
  }
}

bool LidarOnly::BelievesGyro() const {
  return handover_.doubts_imu() &&
         handover_.imu_doubt->contradiction.sensor == ImuSensor::kAccelerometer;
}

std::optional<Vector3> LidarOnly::RateAt(Timestamp stamp) const {
  const std::deque<ImuSample>& samples = context_.stream.imu().samples();
  const bool is_told =
      !samples.empty() && samples.front().stamp <= stamp && stamp <= samples.back().stamp;
  if (!BelievesGyro() || !is_told) return std::nullopt;
  return SampleAt(samples, stamp).w_imu_radps;
}

void LidarOnly::LeaveGyro() {
  if (!tracker_ || !tracker_->has_gyro()) return;
  seed_.motion.emplace().gyro_bias = -tracker_->w_imu_radps();
  TrackOn(tracker_->history().head(), std::nullopt);
}

void LidarOnly::TakeImuAbsent() {
  imu_back_since_.reset();
  LeaveGyro();
}

// An IMU in doubt has to follow the scans for as long again.
void LidarOnly::StartSegment(const SegmentStarts& segment) {
  if (imu_back_since_) imu_back_since_ = segment.first.stamp;
  if (handover_.doubts_imu()) handover_.imu_doubt->last = segment.first.stamp;
  imu_agreement_.Restart();
}

void LidarOnly::CompareWithImu(const MatchOutcome& outcome, bool is_fused) {
  if (!imu_back_since_) return;
  ImuDoubt& doubt = *handover_.imu_doubt;
  context_.stuck_imu.Add(context_.stream.imu().samples(), outcome.sweep->end);
  if (const auto stuck = context_.stuck_imu.found()) {
    doubt.last = outcome.sweep->end;
    // The motion that was not followed is another sensor's.
    if (stuck->sensor != doubt.contradiction.sensor) {
      doubt.contradiction = ContradictionOf(*stuck, stuck->before.stamp);
    }
  }
  if (!is_fused || outcome.is_relocalized) return imu_agreement_.Restart();
  const Timestamp middle = outcome.sweep->middle();
  const Estimate estimate = tracker_->history().At(middle);
  const NavState& state = estimate.state;
  const ImuBuffer& imu = context_.stream.imu();
  ImuAgreement::Belief belief = BeliefAbout(doubt.biases, imu.NoiseAt(outcome.sweep->end),
                                            InMap(state, doubt.g_world), context_);
  // A world that tilts tilts gravity.
  belief.accel_bias_std_mps2 +=
      doubt.g_world.norm() * std::sqrt(estimate.cov.diagonal().segment<3>(kRot).maxCoeff());
  imu_agreement_.Add({middle, outcome.match.T_map_imu, outcome.match.cov}, imu, belief);
  if (const auto found = imu_agreement_.Find(belief)) {
    doubt.last = middle;
    doubt.contradiction = *found;
  }
  if (!BelievesGyro()) LeaveGyro();
}

bool LidarOnly::FollowsAgain(Timestamp middle) const {
  const ImuDoubt& doubt = *handover_.imu_doubt;
  const int doublings = std::min(doubt.num_before, kLidarOnly.max_doublings);
  const double wait_s = kLidarOnly.doubts_imu_for_s * (1 << doublings);
  return SecondsBetween(doubt.last, middle) > wait_s &&
         imu_agreement_.HasShownAlike(doubt.contradiction, doubt.last);
}

}  // namespace lio
