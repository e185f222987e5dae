// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The first state from the coarse track and the inertial samples, once they agree what the samples
// mean.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lio/filter/preintegration.hpp"
#include "lio/pipeline/options_fields.hpp"
#include "lio/verdict/rig_findings.hpp"
#include "pipeline/estimate_report.hpp"
#include "pipeline/initializing.hpp"

namespace lio {
namespace {

std::string NameOfUnits(ImuUnits units) {
  return std::string(kEnumNames<ImuUnits>[static_cast<std::size_t>(units)]);
}

std::string NameOfGravity(GravityInput gravity) {
  return std::string(kEnumNames<GravityInput>[static_cast<std::size_t>(gravity)]);
}

// Turns the extrinsic into the axes that the messages were found to have; its translation stays.
Pose TurnedExtrinsic(const ImuConvention& found, const Rig& rig) {
  const Pose T = rig.T_imu_lidar.value_or(Pose{});
  return {(Quaternion(found.R_imu_sent).conjugate() * T.rotation).normalized(), T.translation};
}

// Why a stated convention is not the messages'. Turned axes and a turned extrinsic are the same to
// all that moves: both are named.
std::vector<Cause> ConventionCauses(const ImuConvention& found, const Rig& rig,
                                    const std::string& evidence) {
  const std::string read_them = "rig:\n  imu:\n    units: auto\n";
  if (found.R_imu_sent == Matrix3::Identity()) {
    return {{CauseKind::kImuUnits, Trust::kNo, 0.0, evidence, read_them}};
  }
  return {{CauseKind::kExtrinsicRotation, Trust::kNo, 0.0, evidence,
           ExtrinsicYaml(TurnedExtrinsic(found, rig))},
          {CauseKind::kImuAxes, Trust::kNo, 0.0, evidence, read_them}};
}

// Tells the user what to configure for messages of the convention that was found.
std::string FixFor(const ImuConvention& found, const Rig& rig) {
  const std::string fix = "set rig.imu.units: auto";
  if (found.R_imu_sent == Matrix3::Identity()) return fix + " or " + NameOfUnits(UnitsOf(found));
  const Pose T = TurnedExtrinsic(found, rig);
  return fmt::format(
      "{}, or turn rig.T_imu_lidar: translation_m: [{:.3f}, {:.3f}, {:.3f}], rotation_wxyz: "
      "[{:.5f}, {:.5f}, {:.5f}, {:.5f}]",
      fix, T.translation.x(), T.translation.y(), T.translation.z(), T.rotation.w(), T.rotation.x(),
      T.rotation.y(), T.rotation.z());
}

}  // namespace

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

std::optional<Transition> Initializing::TryStart(Timestamp stamp) {
  if (IsInDoubt(stamp)) {
    context_.outputs.NotifyWaiting(
        stamp, "the IMU's units and axes are in doubt: initialization waits for turns");
  } else if (auto transition = TryStartAsItMoves(stamp)) {
    return transition;
  }
  const bool still_waits = !scans_.empty();
  if (still_waits &&
      SecondsBetween(context_.sweeps.front()->start, stamp) > kInitializing.max_window_s) {
    ForgetOldestScan();
  }
  return std::nullopt;
}

std::optional<Transition> Initializing::TryStartAsItMoves(Timestamp stamp) {
  const bool is_calm = IsVeryCalm(stamp);
  std::size_t first_at_rest = scans_.size() - 1;
  while (first_at_rest > 0 && !HasMovedSince(first_at_rest - 1, is_calm)) --first_at_rest;
  const Timestamp rest_begin = context_.sweeps[first_at_rest]->start;
  if (SecondsBetween(rest_begin, stamp) >= context_.options.start.rest_s &&
      scans_.size() - first_at_rest >= kInitializing.min_scans_at_rest) {
    return TryStartAtRest(rest_begin, stamp);
  }
  return first_at_rest > 0 ? TryStartInMotion(stamp) : std::nullopt;
}

std::optional<Transition> Initializing::TryStartAtRest(Timestamp begin, Timestamp stamp) {
  const std::vector<ImuSample> samples = context_.stream.imu().Between(begin, stamp);
  if (samples.size() < kInitializing.min_samples_at_rest) return std::nullopt;
  const ImuStatistics statistics = Summarise(samples);
  const StartOptions& limits = context_.options.start;
  const bool is_calm = statistics.gyro_std_radps < limits.max_gyro_std_radps &&
                       statistics.accel_std_mps2 < limits.max_accel_std_mps2;
  if (!is_calm && SecondsBetween(begin, stamp) < kInitializing.max_rest_wait_s) {
    context_.outputs.NotifyWaiting(
        stamp,
        fmt::format("waiting for rest: gyro spread {:.4f} rad/s (limit {:.4f}), accelerometer "
                    "spread {:.3f} m/s^2 (limit {:.3f})",
                    statistics.gyro_std_radps, limits.max_gyro_std_radps, statistics.accel_std_mps2,
                    limits.max_accel_std_mps2));
    return std::nullopt;
  }
  bool is_accepted = false;
  auto transition = CheckForceAtRest(statistics.mean_f_mps2, stamp, is_accepted);
  if (transition || !is_accepted) return transition;
  if (context_.convention.MayBeDegrees(samples)) {  // should they be rad/s, the drive tells
    ImuConvention found = context_.stream.imu().convention();
    found.is_in_deg = true;
    return SetConvention(
        found, fmt::format("at rest the gyro's noise is {:.2f}", RateNoise(samples)), stamp);
  }
  const std::size_t last = scans_.size() - 1;
  return StartFrom(StartAtRest(samples, context_.sweeps[last]->start, context_.options.rig), last,
                   true);
}

// The mean force over a rest tells its unit and whether gravity is in it.
std::optional<Transition> Initializing::CheckForceAtRest(const Vector3& mean_f_mps2,
                                                         Timestamp stamp, bool& is_accepted) {
  const auto verdict = context_.convention.JudgeForce(mean_f_mps2);
  if (verdict.force == ForceAtRest::kUnclear) {
    context_.outputs.NotifyWaiting(
        stamp, verdict.evidence +
                   ", neither m/s^2 nor g nor without gravity: initialization waits; check the "
                   "IMU's driver");
    return std::nullopt;
  }
  const bool has_gravity = verdict.force != ForceAtRest::kWithoutGravity;
  if (auto rejection = CheckGravity(has_gravity, verdict.evidence, stamp)) return rejection;
  if (has_gravity) {
    context_.convention.KeepForceUnit();
    if (verdict.convention != context_.stream.imu().convention()) {
      return SetConvention(verdict.convention, verdict.evidence, stamp);
    }
  }
  is_accepted = true;
  return std::nullopt;
}

std::optional<Transition> Initializing::CheckGravity(bool is_there, const std::string& evidence,
                                                     Timestamp stamp) const {
  const GravityInput expected = context_.options.rig.imu.gravity;
  const GravityInput found = is_there ? GravityInput::kPresent : GravityInput::kRemoved;
  if (expected == GravityInput::kAutomatic || expected == found) return std::nullopt;
  context_.examiner.Contradict({{CauseKind::kImuGravity, Trust::kNo, 0.0,
                                 fmt::format("gravity is {} in the accelerometer's reading ({})",
                                             NameOfGravity(found), evidence),
                                 "rig:\n  imu:\n    gravity: auto\n"}});
  return Reject(stamp,
                fmt::format("gravity is {0} in the accelerometer's reading, but "
                            "rig.imu.gravity says {1} ({2}): set rig.imu.gravity: auto or {0}",
                            NameOfGravity(found), NameOfGravity(expected), evidence));
}

std::optional<Transition> Initializing::TryStartInMotion(Timestamp stamp) {
  const StartOptions& options = context_.options.start;
  const Timestamp begin = context_.sweeps.front()->start;
  if (SecondsBetween(begin, stamp) < options.moving_window_s) return std::nullopt;
  const double waited_s = SecondsBetween(*since_, stamp);
  if (waited_s < options.wait_for_rest_s) {
    context_.outputs.NotifyWaiting(stamp, fmt::format("in motion: waiting for rest, {:.0f} s more",
                                                      options.wait_for_rest_s - waited_s));
    ForgetOldestScan();
    return std::nullopt;
  }
  return AlignInMotion(begin, stamp);
}

std::optional<Transition> Initializing::AlignInMotion(Timestamp begin, Timestamp stamp) {
  std::vector<MatchedPose> poses;
  for (const Scan& scan : scans_) {
    if (scan.is_matched) poses.push_back(scan.pose);
  }
  const ImuBuffer& imu = context_.stream.imu();
  const std::vector<ImuSample> samples(imu.samples().begin(), imu.samples().end());
  const Vector3 mean_f_mps2 = Summarise(imu.Between(begin, stamp)).mean_f_mps2;
  const std::optional<bool> has_gravity = context_.convention.GravityInMotion(mean_f_mps2);
  const std::string seen = fmt::format("{:.2f} m/s^2 in the mean", mean_f_mps2.norm());
  MovingStart moving;
  if (!has_gravity) {
    moving.why_not = "the accelerometer reads " + seen + ": is it in g, or without gravity?";
  } else if (auto rejection = CheckGravity(*has_gravity, seen, stamp)) {
    return rejection;
  } else {
    Rig rig = context_.options.rig;
    rig.imu = RaisedTo(imu.NoiseAt(stamp), rig.imu);
    moving = StartMoving(samples, poses, begin, rig, *has_gravity);
  }
  if (moving.start) return StartFrom(*moving.start, 0, false);
  context_.outputs.NotifyWaiting(stamp, "no start in motion yet: " + moving.why_not);
  if (SecondsBetween(begin, stamp) < kInitializing.max_window_s) return std::nullopt;
  // Perhaps the tracker was misled by a gyro in wrong units or axes, or lost its way without one.
  context_.convention.TrustGyro(!context_.convention.trusts_gyro());
  context_.sweeps.erase(context_.sweeps.begin(),
                        context_.sweeps.begin() + static_cast<std::ptrdiff_t>(scans_.size()));
  return Retry();
}

// Reads all samples by this convention, also those of the past seconds, and begins again with them.
Transition Initializing::SetConvention(const ImuConvention& found, const std::string& evidence,
                                       Timestamp stamp) {
  const Rig& rig = context_.options.rig;
  const std::string what = "inertial messages: " + Describe(found) + " (" + evidence + ")";
  if (rig.imu.units != ImuUnits::kAutomatic) {
    context_.examiner.Contradict(ConventionCauses(found, rig, what));
    return Reject(stamp, what + ", rig.imu.units says " + NameOfUnits(rig.imu.units) + ": " +
                             FixFor(found, rig));
  }
  if (handover_.origin == Handover::Origin::kInertial) TurnHandover(found);
  context_.stream.SetConvention(found);
  context_.examiner.SetConvention(found);
  context_.extrinsic.Restart();
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

// Turns the earlier fix by the rotation since then, integrated from the samples that are still in
// the buffer.
void Initializing::TurnByGyro(const Estimate& now, LastFix& earlier) const {
  const std::vector<ImuSample> samples = context_.stream.imu().Between(earlier.stamp, now.stamp);
  if (samples.empty()) return;
  const Biases biases{now.state.gyro_bias, now.state.accel_bias};
  const Preintegration turn =
      Preintegrate(samples, samples.front().stamp, samples.back().stamp, biases, {});
  earlier.T_world_imu.rotation = earlier.T_world_imu.rotation * turn.rotation;
  earlier.T_map_imu.rotation = earlier.T_map_imu.rotation * turn.rotation;
}

// The first state, placed in the world that was published before, if there was one.
Transition Initializing::StartFrom(StartState start, std::size_t first_sweep, bool is_at_rest) {
  using Origin = Handover::Origin;
  const bool has_gravity = !start.g_world.isZero();
  if (handover_.origin == Origin::kInertial || handover_.origin == Origin::kLidar) {
    LastFix& fix = handover_.last_fix;
    TurnByGyro(start.estimate, fix);
    if (handover_.origin == Origin::kLidar && has_gravity) {
      Level(start.estimate.state.T_world_imu.rotation, fix);
    }
    PlaceInWorld(fix, has_gravity, start.estimate);
  }
  handover_.origin = Origin::kInertial;
  handover_.T_world_start = start.estimate.state.T_world_imu;
  handover_.T_map_start = start.estimate.state.T_map_imu;
  handover_.last_fix = MakeFix(start.estimate.stamp, start.estimate, start.g_world);
  handover_.last_fused = start.estimate.stamp;
  context_.convention.BeginMap(start.estimate.stamp);
  context_.sweeps.erase(context_.sweeps.begin(),
                        context_.sweeps.begin() + static_cast<std::ptrdiff_t>(first_sweep));
  const ImuConvention& convention = context_.stream.imu().convention();
  const std::string read_as = convention == ImuConvention{} ? "" : "; " + Describe(convention);
  context_.outputs.Notify(start.estimate.stamp, Notice::Severity::kInfo, start.how + read_as);
  return {.trigger = Trigger::kStarted,
          .handover = handover_,
          .start = std::move(start),
          .is_at_rest = is_at_rest};
}

Transition Initializing::Reject(Timestamp stamp, const std::string& why) const {
  context_.outputs.Notify(stamp, Notice::Severity::kError, why);
  return {.trigger = Trigger::kContradicted, .handover = handover_};
}

}  // namespace lio
