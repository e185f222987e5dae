// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// A start needs to know what the inertial messages mean: units, axes, gravity. These functions
// judge whether they mean something else than was believed, and begin anew if so.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lio/pipeline/options_fields.hpp"
#include "pipeline/convention_causes.hpp"
#include "pipeline/initializing.hpp"

namespace lio {
bool Initializing::IsInDoubt(Timestamp stamp) const {
  const bool has_restarted = handover_.origin == Handover::Origin::kInertial ||
                             handover_.origin == Handover::Origin::kLidar;
  return has_restarted && context_.convention.IsInDoubt(handover_.last_fix.stamp, stamp);
}

// Gives a transition when the tracked poses are of no use any more.
std::optional<Transition> Initializing::JudgeConvention(Timestamp stamp) {
  ImuConventionMonitor& convention = context_.convention;
  const std::vector<ImuSample> samples =
      context_.stream.imu().Between(context_.sweeps.front()->start, scans_.back().pose.stamp);
  const auto num_matched = static_cast<std::size_t>(std::count_if(
      scans_.begin(), scans_.end(), [](const Scan& scan) { return scan.is_matched; }));
  using Kind = ImuConventionMonitor::Finding::Kind;
  const auto finding =
      convention.JudgeInitializing({scans_.size(), num_matched, samples}, IsInDoubt(stamp));
  if (finding.kind == Kind::kMisleadingGyro) return Retry();
  if (finding.kind == Kind::kOtherwise) {
    return SetConvention(finding.convention, finding.evidence, stamp);
  }
  return std::nullopt;
}

// The mean force over a rest tells its unit and whether gravity is in it.
Initializing::ForceCheck Initializing::CheckForceAtRest(const Vector3& mean_f_mps2,
                                                        Timestamp stamp) {
  const auto verdict = context_.convention.JudgeForce(mean_f_mps2);
  if (verdict.force == ForceAtRest::kUnclear) {
    context_.outputs.NotifyWaiting(
        stamp, verdict.evidence +
                   ", neither m/s^2 nor g nor without gravity: initialization waits; check the "
                   "IMU's driver");
    return {};
  }
  const bool has_gravity = verdict.force != ForceAtRest::kWithoutGravity;
  if (auto rejection = CheckGravity(has_gravity, verdict.evidence, stamp)) {
    return {.transition = std::move(rejection)};
  }
  if (has_gravity) {
    context_.convention.KeepForceUnit();
    if (verdict.convention != context_.stream.imu().convention()) {
      return {.transition = SetConvention(verdict.convention, verdict.evidence, stamp)};
    }
  }
  return {.is_accepted = true};
}

std::optional<Transition> Initializing::CheckGravity(bool is_there, const std::string& evidence,
                                                     Timestamp stamp) const {
  const GravityInput expected = context_.options.rig.imu.gravity;
  const GravityInput found = is_there ? GravityInput::kPresent : GravityInput::kRemoved;
  if (expected == GravityInput::kAutomatic || expected == found) return std::nullopt;
  context_.examiner.Contradict(
      {{CauseKind::kImuGravity, Trust::kNo, 0.0,
        fmt::format("gravity is {} in the accelerometer's reading ({})", EnumName(found), evidence),
        "rig:\n  imu:\n    gravity: auto\n"}});
  return Reject(stamp,
                fmt::format("gravity is {0} in the accelerometer's reading, but "
                            "rig.imu.gravity says {1} ({2}): set rig.imu.gravity: auto or {0}",
                            EnumName(found), EnumName(expected), evidence));
}

// Reads all samples by this convention, also those of the past seconds, and begins again with them.
Transition Initializing::SetConvention(const ImuConvention& found, const std::string& evidence,
                                       Timestamp stamp) {
  const Rig& rig = context_.options.rig;
  const std::string what = "inertial messages: " + Describe(found) + " (" + evidence + ")";
  if (rig.imu.units != ImuUnits::kAutomatic) {
    context_.examiner.Contradict(ConventionCauses(found, rig, Trust::kNo, what));
    return Reject(stamp, fmt::format("{}, rig.imu.units says {}: {}", what, EnumName(rig.imu.units),
                                     ConventionFix(found, rig)));
  }
  const bool was_started = handover_.origin == Handover::Origin::kInertial && !handover_.is_placed;
  if (was_started) TurnHandover(found);
  context_.stream.SetConvention(found);
  context_.examiner.SetConvention(found);
  context_.extrinsic.Restart();
  context_.sensor_errors = SensorFixedErrors();  // they were learned in other axes
  context_.convention.Restart();
  context_.convention.TrustGyro(true);
  context_.convention.ForgetDoubt();
  context_.outputs.Notify(stamp, Notice::Severity::kWarning, what);
  return Retry();
}

// A start with wrong axes turned all that was published since. This turns it back. The path
// in map is the lidar's, rigid; the filter's world was bent by a gravity in a wrong direction.
void Initializing::TurnHandover(const ImuConvention& found) {
  const Matrix3 R_found_believed =
      found.R_imu_sent * context_.stream.imu().convention().R_imu_sent.transpose();
  const Pose turn{Quaternion(Matrix3(R_found_believed.transpose())), Vector3::Zero()};
  const Pose T_start_map = handover_.T_map_start.Inverse();
  LastFix& fix = handover_.last_fix;
  const Pose since_start = T_start_map * fix.T_map_imu;
  const Vector3 v_imu = fix.T_world_imu.rotation.conjugate() * fix.v_world_imu;
  fix.T_world_imu = handover_.T_world_start * turn * since_start;
  fix.v_world_imu = fix.T_world_imu.rotation * v_imu;
  if (!handover_.is_map_by_lidar) fix.T_map_imu = handover_.T_map_start * turn * since_start;
}

Transition Initializing::Reject(Timestamp stamp, const std::string& why) const {
  context_.outputs.Notify(stamp, Notice::Severity::kError, why);
  return {.trigger = Trigger::kContradicted, .handover = handover_};
}

}  // namespace lio
