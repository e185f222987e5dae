// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The first state from the coarse track and the inertial samples, once it is known what the samples
// mean (initializing_convention.cpp).
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "lio/filter/filter_parameters.hpp"
#include "lio/filter/preintegration.hpp"
#include "lio/imu/rest_force.hpp"
#include "lio/sensor/gap.hpp"
#include "pipeline/estimate_report.hpp"
#include "pipeline/initializing.hpp"
#include "pipeline/outage.hpp"

namespace lio {
namespace {

// How far the integral of made-up and of saturated rates may be off, 1 sigma per axis: each is off
// to the same side for a while.
double UnmeasuredTurnStd_rad(std::span<const ImuSample> samples) {
  constexpr double kSaturatedStd_radps = kFilterParameters.imu_outage.saturated_gyro_std_radps;
  double std_rad = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const ImuSample& from = samples[i - 1];
    const ImuSample& to = samples[i];
    const double made_up = std::min(from.made_up_w_std_radps, to.made_up_w_std_radps);
    const bool is_saturated = from.is_rate_saturated || to.is_rate_saturated;
    std_rad += std::max(made_up, is_saturated ? kSaturatedStd_radps : 0.0) *
               SecondsBetween(from.stamp, to.stamp);
  }
  return std_rad;
}

bool ShowsTurn(const MatchedPose& pose) {
  return pose.cov.diagonal().tail<3>().maxCoeff() <
         kRest.at_start.max_turn_rad * kRest.at_start.max_turn_rad;
}

}  // namespace

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
  const Calm calm = CalmOf(stamp);
  std::size_t first_at_rest = scans_.size() - 1;
  while (first_at_rest > 0 && !HasMovedSince(first_at_rest - 1, calm)) --first_at_rest;
  const Timestamp rest_begin = context_.sweeps[first_at_rest]->start;
  if (SecondsBetween(rest_begin, stamp) >= context_.options.start.rest_s &&
      scans_.size() - first_at_rest >= kInitializing.min_scans_at_rest) {
    return TryStartAtRest(first_at_rest, stamp);
  }
  return first_at_rest > 0 ? TryStartInMotion(stamp) : std::nullopt;
}

std::optional<Transition> Initializing::TryStartAtRest(std::size_t first, Timestamp stamp) {
  const Timestamp begin = context_.sweeps[first]->start;
  const std::vector<ImuSample> samples = context_.stream.imu().Between(begin, stamp);
  if (std::ssize(samples) < kInitializing.min_samples_at_rest) return std::nullopt;
  const ImuStatistics statistics = Summarise(samples);
  const StartOptions& limits = context_.options.start;
  const bool is_calm = statistics.gyro_std_radps < limits.max_gyro_std_radps &&
                       statistics.accel_std_mps2 < limits.max_accel_std_mps2;
  if (SpreadOfTurnedForce(samples) > kInitializing.max_shaken_mps2) return TryStartInMotion(stamp);
  if (!is_calm && SecondsBetween(begin, stamp) < kInitializing.max_rest_wait_s) {
    context_.outputs.NotifyWaiting(
        stamp,
        fmt::format("waiting for rest: gyro spread {:.4f} rad/s (limit {:.4f}), accelerometer "
                    "spread {:.3f} m/s^2 (limit {:.3f})",
                    statistics.gyro_std_radps, limits.max_gyro_std_radps, statistics.accel_std_mps2,
                    limits.max_accel_std_mps2));
    return std::nullopt;
  }
  ForceCheck check = CheckForceAtRest(statistics.mean_f_mps2, stamp);
  if (!check.is_accepted) return std::move(check.transition);
  if (context_.convention.MayBeDegrees(samples)) {  // should they be rad/s, the drive tells
    ImuConvention found = context_.stream.imu().convention();
    found.is_in_deg = true;
    return SetConvention(
        found, fmt::format("at rest the gyro's noise is {:.2f}", RateNoise(samples)), stamp);
  }
  const std::size_t last = scans_.size() - 1;
  ShownMotion shown = ShownBetween(scans_[first].pose, scans_[last].pose);
  // A direction that a scan leaves open is not only a shift, so that it may not show the turn,
  // either. One that shows it tells how sure it is if it is of the second half.
  std::size_t seen = last;
  while (seen > first + 1 && !ShowsTurn(scans_[seen].pose)) --seen;
  const ShownMotion by_seen = ShownBetween(scans_[first].pose, scans_[seen].pose);
  shown.turn_rad = by_seen.turn_rad;
  if (ShowsTurn(scans_[seen].pose) && seen - first > (last - first) / 2) {
    shown.turn_std_rad = by_seen.turn_std_rad;
  }
  if (MayFollowTraffic(stamp, is_calm)) return RetryWithNextSweep();
  return StartFrom(StartAtRest(samples, context_.sweeps[last]->start, context_.options.rig, shown),
                   last, shown.shift_m < kRest.at_start.max_shift_m);
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

// The bias of a gyro that was right before the way was lost is found wherever it has jumped to. An
// accelerometer's is not: where scans do not tell the height, it would be anywhere.
MovingStart Initializing::Align(Timestamp begin, Timestamp stamp, bool has_gravity) const {
  std::vector<MatchedPose> poses;
  for (const Scan& scan : scans_) {
    if (scan.is_matched) poses.push_back(scan.pose);
  }
  const ImuBuffer& imu = context_.stream.imu();
  const std::vector<ImuSample> samples(imu.samples().begin(), imu.samples().end());
  Rig rig = context_.options.rig;
  rig.imu = RaisedTo(imu.NoiseAt(stamp), rig.imu);
  MovingStart moving = StartMoving(samples, poses, begin, rig, has_gravity);
  const bool was_right =
      handover_.origin == Handover::Origin::kInertial && context_.convention.is_settled();
  if (moving.start || !was_right) return moving;
  double& bias_std_radps = rig.imu.gyro_bias_std_radps;
  const double usual_std_radps = std::exchange(
      bias_std_radps, std::max(bias_std_radps, kInitializing.jumped_gyro_bias_std_radps));
  MovingStart jumped = StartMoving(samples, poses, begin, rig, has_gravity);
  if (!jumped.start) return moving;
  context_.outputs.Notify(
      stamp, Notice::Severity::kWarning,
      fmt::format("the gyro's bias is now {:.3f} rad/s, and rig.imu.gyro_bias_std_radps says "
                  "{:.3f}; the filter goes on with it, but look at the unit",
                  jumped.start->estimate.state.gyro_bias.cwiseAbs().maxCoeff(), usual_std_radps));
  return jumped;
}

// Most scans leave the way along a level direction open, as in a tunnel. The noise of that
// direction tells a speed there, which is none.
bool Initializing::IsWayUnseen() const {
  const Vector3 up = up_map_.normalized();
  const Matrix3 level = Matrix3::Identity() - up * up.transpose();
  int num_matched = 0;
  int num_open = 0;
  for (const Scan& scan : scans_) {
    if (!scan.is_matched) continue;
    ++num_matched;
    const Matrix3 to_level = level * scan.pose.T_any_imu.rotation.toRotationMatrix();
    const Matrix3 cov = to_level * scan.pose.cov.topLeftCorner<3, 3>() * to_level.transpose();
    const double largest_var = Eigen::SelfAdjointEigenSolver<Matrix3>(cov).eigenvalues()[2];
    if (largest_var > kInitializing.open_std_m * kInitializing.open_std_m) ++num_open;
  }
  return num_open > kInitializing.max_open_share * num_matched;
}

std::optional<Initializing::SpeedThen> Initializing::SpeedOfTrackAt(Timestamp stamp) const {
  if (scans_.size() < 2) return {};
  const auto is_before = [&](const Scan& scan) { return scan.pose.stamp < stamp; };
  const auto last = std::prev(scans_.end());
  const auto from = std::find_if_not(scans_.begin(), std::prev(last), is_before);
  const auto to =
      std::next(from, std::min(std::distance(from, last), kInitializing.num_steps_of_speed));
  const double since_s = SecondsBetween(from->pose.stamp, to->pose.stamp);
  if (!(since_s > 0.0)) return {};  // the clock was set back
  const double way_m = (to->pose.T_any_imu.translation - from->pose.T_any_imu.translation).norm();
  return SpeedThen{from->pose.stamp, way_m / since_s};
}

Initializing::BuildingsSay Initializing::WhatBuildingsSay() const {
  const auto& [then, speeds] = by_buildings_;
  const std::optional<SpeedThen> track = SpeedOfTrackAt(then);
  if (!speeds || !track) return BuildingsSay::kNothing;
  const double allowance_mps =
      kConstantVelocity.velocity_seed_std_mps +
      kInitializing.max_accel_mps2 * std::abs(SecondsBetween(then, track->stamp));
  const double least_mps = speeds->min_mps - allowance_mps;
  if (track->mps < least_mps || track->mps > speeds->max_mps + allowance_mps) {
    return BuildingsSay::kOtherwise;
  }
  return least_mps > 0.0 ? BuildingsSay::kItMoves : BuildingsSay::kNothing;
}

bool Initializing::MayFollowTraffic(Timestamp stamp, bool is_calm) {
  const BuildingsSay say = WhatBuildingsSay();
  const bool was_in_traffic = handover_.in_traffic && SecondsBetween(*handover_.in_traffic, stamp) <
                                                          kInitializing.in_traffic_s;
  if (say == BuildingsSay::kOtherwise) {
    handover_.in_traffic = stamp;
  } else if (say == BuildingsSay::kItMoves || is_calm || !was_in_traffic) {
    handover_.in_traffic.reset();
    return false;
  }
  context_.outputs.NotifyWaiting(
      stamp,
      "no start yet: what is higher than any vehicle moves otherwise than most of what is seen, so "
      "that traffic may go along; the start waits until both agree, or for a stop");
  return true;
}

Transition Initializing::RetryWithNextSweep() {
  context_.ForgetSweeps(scans_.size());
  return Retry();
}

std::optional<Transition> Initializing::AlignInMotion(Timestamp begin, Timestamp stamp) {
  if (IsWayUnseen()) {
    context_.outputs.NotifyWaiting(stamp,
                                   "no start in motion yet: the scans do not show how fast the "
                                   "body moves along one level direction (a tunnel?); it waits "
                                   "until they do, or for a stop");
    return std::nullopt;
  }
  const Vector3 mean_f_mps2 = Summarise(context_.stream.imu().Between(begin, stamp)).mean_f_mps2;
  const std::optional<bool> has_gravity = context_.convention.GravityInMotion(mean_f_mps2);
  const std::string seen = fmt::format("{:.2f} m/s^2 in the mean", mean_f_mps2.norm());
  MovingStart moving;
  if (!has_gravity) {
    moving.why_not = "the accelerometer reads " + seen + ": is it in g, or without gravity?";
  } else if (auto rejection = CheckGravity(*has_gravity, seen, stamp)) {
    return rejection;
  } else {
    moving = Align(begin, stamp, *has_gravity);
  }
  if (moving.start && MayFollowTraffic(stamp, false)) return RetryWithNextSweep();
  if (moving.start) return StartFrom(*moving.start, 0, false);
  context_.outputs.NotifyWaiting(stamp, "no start in motion yet: " + moving.why_not);
  if (SecondsBetween(begin, stamp) < kInitializing.max_window_s) return std::nullopt;
  // Perhaps the tracker was misled by a gyro in wrong units or axes, or lost its way without one.
  context_.convention.TrustGyro(!context_.convention.trusts_gyro());
  return RetryWithNextSweep();
}

// Turns the earlier fix by the rotation since then, integrated from the samples of the last
// seconds, and adds to `doubt` how far it may be off.
void Initializing::TurnByGyro(const Estimate& now, LastFix& earlier, YawDoubt& doubt) const {
  const Timestamp oldest = now.stamp - Duration::FromSeconds(kInitializing.max_turn_back_s);
  const std::vector<ImuSample> samples =
      context_.stream.imu().Between(std::max(earlier.stamp, oldest), now.stamp);
  const Timestamp first = samples.empty() ? now.stamp : samples.front().stamp;
  const bool is_unseen_before = first - earlier.stamp >= kImuGap.sparse;
  const double unseen_s = is_unseen_before ? SecondsBetween(earlier.stamp, first) : 0.0;
  const double turn_std_rad = std::min(
      kFilterParameters.imu_outage.gap_gyro_std_radps * unseen_s + UnmeasuredTurnStd_rad(samples),
      kOutage.max_yaw_std_rad);
  doubt.Add(turn_std_rad * turn_std_rad, earlier.T_world_imu.translation);
  if (samples.empty()) return;
  const Biases biases{now.state.gyro_bias, now.state.accel_bias};
  const Preintegration turn =
      Preintegrate(samples, is_unseen_before ? first : earlier.stamp, now.stamp, biases, {});
  earlier.T_world_imu.rotation = earlier.T_world_imu.rotation * turn.rotation;
  earlier.T_map_imu.rotation = earlier.T_map_imu.rotation * turn.rotation;
}

// The first state, placed in the world that was published before, if there was one.
Transition Initializing::StartFrom(StartState start, std::size_t first_sweep, bool is_at_rest) {
  using Origin = Handover::Origin;
  const bool has_gravity = !start.g_world.isZero();
  if (handover_.origin == Origin::kInertial || handover_.origin == Origin::kLidar) {
    LastFix& fix = handover_.last_fix;
    TurnByGyro(start.estimate, fix, handover_.yaw_doubt);
    if (handover_.origin == Origin::kLidar && has_gravity) {
      const Pose T_map_world = fix.T_map_imu * fix.T_world_imu.Inverse();
      Level(start.estimate.state.T_world_imu.rotation, fix);
      // A world that was level before leads to a map that is, too; another map stays as it was.
      if (handover_.was_level) fix.T_map_imu = T_map_world * fix.T_world_imu;
    }
    PlaceInWorld(fix, has_gravity, start.estimate);
    if (has_gravity) MoveUnsureYaw(start.estimate, handover_.yaw_doubt);
  }
  handover_.origin = Origin::kInertial;
  handover_.is_placed = false;
  handover_.T_world_start = start.estimate.state.T_world_imu;
  handover_.T_map_start = start.estimate.state.T_map_imu;
  handover_.last_fix = MakeFix(start.estimate.stamp, start.estimate, start.g_world);
  handover_.last_fused = start.estimate.stamp;
  context_.convention.BeginMap(start.estimate.stamp);
  context_.ForgetSweeps(first_sweep);
  const ImuConvention& convention = context_.stream.imu().convention();
  const std::string read_as = convention == ImuConvention{} ? "" : "; " + Describe(convention);
  context_.outputs.Notify(start.estimate.stamp, Notice::Severity::kInfo, start.how + read_as);
  return {.trigger = Trigger::kStarted,
          .handover = handover_,
          .start = std::move(start),
          .is_at_rest = is_at_rest};
}

}  // namespace lio
