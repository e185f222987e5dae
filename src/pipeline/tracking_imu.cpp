// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tracking compares the inertial samples with the motion that scans show, and goes on without them
// where an axis has stopped or they contradict the scans.
#include <algorithm>
#include <utility>

#include "lio/filter/estimate_change.hpp"
#include "pipeline/tracking.hpp"

namespace lio {

// A wrong unit, axis or clock contradicts the scans as well, from the first motion on, and is found
// elsewhere: a sensor breaks where it was right.
std::optional<ImuContradiction> Tracking::CompareWithImu(const MatchedScan& scan) {
  const MatchOutcome& outcome = scan.outcome;
  if (!outcome.match.IsUsable()) return std::nullopt;
  if (outcome.is_relocalized || outage_.is_running() || is_map_rebased_) {
    imu_agreement_.Restart();
    return std::nullopt;
  }
  const NavState& state = history_.At(scan.middle()).state;
  const ImuAgreement::Belief belief = BeliefAbout({state.gyro_bias, state.accel_bias}, scan.noise,
                                                  InMap(handover_.last_fix, g_world_), context_);
  const Timestamp last = imu_agreement_.last().value_or(scan.middle());
  imu_agreement_.Add({scan.middle(), outcome.match.T_map_imu, outcome.match.cov},
                     context_.stream.imu(), belief);
  auto found = imu_agreement_.Find(belief);
  CountFollowed(found.has_value(), belief, last, scan.middle());
  // A match that has slid is no witness against the samples.
  if (!found || outcome.match.HasSlid()) return std::nullopt;
  if (has_followed()) return found;
  if (!has_jumped_ || !IsRigKnown()) return std::nullopt;
  return imu_agreement_.FindAfterJump(belief);
}

// Counts the time for which the samples follow the scans, until it is long enough.
void Tracking::CountFollowed(bool is_contradicted, const ImuAgreement::Belief& belief,
                             Timestamp from, Timestamp to) {
  if (imu_agreement_.HasJumped(belief)) {
    has_jumped_ = has_jumped_ || has_followed();
    followed_s_ = 0.0;
  }
  if (has_followed()) {
    has_jumped_ = false;
  } else if (is_contradicted) {
    followed_s_ = 0.0;
  } else if (imu_agreement_.HasMoved()) {
    followed_s_ += SecondsBetween(from, to);
  }
}

std::optional<Transition> Tracking::DoubtImu(const MatchedScan& scan) {
  context_.stuck_imu.Add(context_.stream.imu().samples(), scan.end());
  const auto contradiction = CompareWithImu(scan);
  if (is_first_scan_ || outage_.is_running()) return std::nullopt;
  if (const auto stuck = context_.stuck_imu.found()) return LeaveStuckImu(*stuck, scan.end());
  if (contradiction) return LeaveImu(*contradiction, scan);
  return std::nullopt;
}

// All was right until the axis stopped.
Transition Tracking::LeaveStuckImu(const StuckImuDetector::Stuck& stuck, Timestamp end) const {
  const Timestamp since = std::max(stuck.before.stamp, history_.start_stamp());
  StartState known = KnownAt(since);
  const Vector3 w_imu_radps = stuck.before.w_imu_radps - known.estimate.state.gyro_bias;
  ++context_.counters.num_imu_stuck;
  return GoOnWithoutImu(std::move(known), w_imu_radps, ContradictionOf(stuck, since), end);
}

// The pose is the scan's, in the world as it was while the samples still followed.
Transition Tracking::LeaveImu(const ImuContradiction& found, const MatchedScan& scan) const {
  ++context_.counters.num_imu_contradicted;
  StartState known = KnownAt(std::max(found.since, history_.start_stamp()));
  const ImuAgreement::Motion motion = imu_agreement_.MotionNow().value_or(ImuAgreement::Motion{});
  MoveTo(scan.outcome.match.T_map_imu, known.estimate);
  known.estimate.stamp = scan.middle();
  constexpr double kVelocityVar =
      kConstantVelocity.known_velocity_std_mps * kConstantVelocity.known_velocity_std_mps;
  SetVelocity(motion.v_imu_mps, kVelocityVar * Matrix3::Identity(), known.estimate);
  AddUnseenMotion(known.estimate, scan.outcome.match.cov);
  return GoOnWithoutImu(std::move(known), motion.w_imu_radps, found, scan.end());
}

Transition Tracking::GoOnWithoutImu(StartState known, const Vector3& w_imu_radps,
                                    const ImuContradiction& why, Timestamp end) const {
  context_.clocks.Interrupt();  // the offset is kept, to compare the samples with
  context_.outputs.Notify(
      end, Notice::Severity::kWarning,
      why.evidence +
          ": lidar-only odometry until the IMU follows the scans again; look at the "
          "unit, its driver and its mounting");
  const NavState& before = known.estimate.state;
  const Biases biases{before.gyro_bias, before.accel_bias};
  Transition transition = GoLidarOnly(Trigger::kImuDoubted, std::move(known), w_imu_radps);
  const int num_before = handover_.imu_doubt ? handover_.imu_doubt->num_before + 1 : 0;
  transition.handover.imu_doubt = ImuDoubt{.contradiction = why,
                                           .last = end,
                                           .biases = biases,
                                           .g_world = g_world_,
                                           .num_before = num_before};
  return transition;
}

}  // namespace lio
