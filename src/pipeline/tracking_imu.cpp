// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tracking compares the inertial samples with the motion that scans show, and goes on without them
// where they contradict it.
#include "lio/filter/estimate_change.hpp"
#include "pipeline/tracking.hpp"

namespace lio {

ImuAgreement::Belief Tracking::BeliefAt(const MatchedScan& scan) const {
  const NavState& state = history_.At(scan.middle()).state;
  const ImuRig& rig = context_.options.rig.imu;
  const LastFix& fix = handover_.last_fix;
  return {.biases = {state.gyro_bias, state.accel_bias},
          .noise = scan.noise,
          .g_map = fix.T_map_imu.rotation * (fix.T_world_imu.rotation.conjugate() * g_world_),
          .gyro_bias_std_radps = rig.gyro_bias_std_radps,
          .accel_bias_std_mps2 = rig.accel_bias_std_mps2};
}

// A wrong convention contradicts the scans as well, and is found out by a start anew.
std::optional<ImuAgreement::Contradiction> Tracking::CompareWithImu(const MatchedScan& scan) {
  const MatchOutcome& outcome = scan.outcome;
  if (!outcome.match.IsUsable()) return std::nullopt;
  if (outcome.is_relocalized || outage_.is_running() || is_map_rebased_) {
    imu_agreement_.Restart();
    return std::nullopt;
  }
  const ImuAgreement::Belief belief = BeliefAt(scan);
  const std::optional<Timestamp> last = imu_agreement_.last();
  imu_agreement_.Add(
      {scan.middle(), outcome.match.T_map_imu, outcome.match.cov},
      SamplesOfMotion(context_.stream.imu(), last.value_or(scan.middle()), scan.middle()), belief);
  auto found = imu_agreement_.Find(belief);
  if (found && context_.convention.MayBeAnother()) return std::nullopt;
  return found;
}

// The lidar goes on from the scan's pose, in the world as it was while the samples still followed.
Transition Tracking::DoubtImu(const MatchedScan& scan,
                              const ImuAgreement::Contradiction& found) const {
  context_.clocks.Stop();
  context_.outputs.Notify(
      scan.end(), Notice::Severity::kWarning,
      found.evidence +
          " from what scans show: lidar-only odometry until it follows them again; "
          "look at the IMU, its driver and its mounting");
  StartState known;
  known.g_world = g_world_;
  known.estimate = history_.At(std::max(found.since, history_.start_stamp()));
  const ImuAgreement::Motion motion = imu_agreement_.MotionNow().value_or(ImuAgreement::Motion{});
  MoveTo(scan.outcome.match.T_map_imu, known.estimate);
  known.estimate.stamp = scan.middle();
  constexpr double kVelocityVar =
      kConstantVelocity.known_velocity_std_mps * kConstantVelocity.known_velocity_std_mps;
  SetVelocity(motion.v_imu_mps, kVelocityVar * Matrix3::Identity(), known.estimate);
  AddUnseenMotion(known.estimate, scan.outcome.match.cov);

  Transition transition{.trigger = Trigger::kImuDoubted, .handover = handover_};
  transition.handover.keeps_map = true;
  const int num_before = handover_.imu_doubt ? handover_.imu_doubt->num_before + 1 : 0;
  transition.handover.imu_doubt =
      ImuDoubt{.contradiction = found, .last = scan.middle(), .num_before = num_before};
  transition.seed.motion = known.estimate.state;
  transition.seed.motion->gyro_bias = -motion.w_imu_radps;
  transition.start = std::move(known);
  return transition;
}

}  // namespace lio
