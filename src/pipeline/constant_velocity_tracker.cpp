// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/constant_velocity_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "lio/filter/estimate_change.hpp"
#include "lio/scan/sweep.hpp"
#include "pipeline/blind_axis.hpp"

namespace lio {
namespace {

HistoryOptions MakeHistoryOptions(const TrackerOptions& options) {
  HistoryOptions history;
  history.noise.accel_density = kConstantVelocity.accel_density;
  if (options.first_rate_radps) {
    history.noise.gyro_density = kConstantVelocity.gyro_density;
  } else {
    history.noise.gyro_bias_walk_density = options.follows_turns
                                               ? kConstantVelocity.start_turn_accel_density
                                               : kConstantVelocity.min_turn_accel_density;
  }
  history.g_world = Vector3::Zero();
  history.span_s = options.span_s;
  history.nis_limit = options.nis_limit;
  history.max_inflation.translation = 1.0;  // the alignment judges that
  history.imu_outage.gap = Duration{std::numeric_limits<std::int64_t>::max()};  // never
  return history;
}

// The force is made up and has no bias; without a gyro its bias is the turn rate.
Estimate GoOnFrom(Estimate estimate, const TrackerOptions& options) {
  const bool has_gyro = options.first_rate_radps.has_value();
  const double std_radps = has_gyro ? kConstantVelocity.gyro_bias_std_radps
                                    : kConstantVelocity.known_turn_rate_std_radps;
  ForgetBiases(estimate);
  if (!has_gyro) estimate.state.gyro_bias = options.seed.motion.value_or(NavState{}).gyro_bias;
  estimate.state.accel_bias.setZero();
  estimate.cov.block<3, 3>(kGyroBias, kGyroBias) = std_radps * std_radps * Matrix3::Identity();
  return estimate;
}

Estimate Start(Timestamp start, const TrackerOptions& options) {
  if (options.goes_on_from) return GoOnFrom(*options.goes_on_from, options);
  Estimate estimate;
  estimate.stamp = start;
  const bool is_known = options.seed.motion.has_value();
  double turn_rate_std_radps = is_known ? kConstantVelocity.known_turn_rate_std_radps
                                        : kConstantVelocity.start_turn_rate_std_radps;
  if (options.first_rate_radps) turn_rate_std_radps = kConstantVelocity.gyro_bias_std_radps;
  double velocity_std_mps = is_known ? kConstantVelocity.known_velocity_std_mps
                                     : kConstantVelocity.start_velocity_std_mps;
  if (!is_known && options.seed.v_imu_mps) {
    estimate.state.v_world_imu = *options.seed.v_imu_mps;
    velocity_std_mps = kConstantVelocity.velocity_seed_std_mps;
  }
  const auto set = [&](int at, double std) {
    estimate.cov.block<3, 3>(at, at) = std * std * Matrix3::Identity();
  };
  estimate.cov.topLeftCorner<6, 6>() = options.start_cov;
  set(kVel, velocity_std_mps);
  set(kGyroBias, turn_rate_std_radps);
  if (is_known) {
    const NavState& motion = *options.seed.motion;
    estimate.state.v_world_imu = motion.T_world_imu.rotation.conjugate() * motion.v_world_imu;
    estimate.state.gyro_bias = motion.gyro_bias;
  }
  NavState& state = estimate.state;
  state.T_world_imu = options.T_world_start;
  state.T_map_imu = options.T_world_start;
  state.v_world_imu = options.T_world_start.rotation * state.v_world_imu;
  return estimate;
}

// Allows for a pause of unknown length, about half a second.
void AllowUnseenHalfSecond(Estimate& estimate) {
  const double shift_std_m =
      std::max(kConstantVelocity.unseen_shift_m,
               kConstantVelocity.unseen_s * estimate.state.v_world_imu.norm());
  Vector6 motion_var;
  motion_var << Vector3::Constant(shift_std_m * shift_std_m),
      Vector3::Constant(kConstantVelocity.unseen_turn_rad * kConstantVelocity.unseen_turn_rad);
  AllowUnseenMotion(estimate, motion_var,
                    Vector3::Constant(kConstantVelocity.known_velocity_std_mps *
                                      kConstantVelocity.known_velocity_std_mps));
}

// A gyro's rate turns the body alone: it may be of other units, and must not turn the velocity.
ImuSample Rate(Timestamp stamp, const Vector3& w_imu_radps) {
  ImuSample sample;
  sample.stamp = stamp;
  sample.w_imu_radps = w_imu_radps;
  return sample;
}

// The velocity that is constant is that in the imu's axes: a car follows its wheels, and what a
// hand holds swings about a body. So the force is the one that turns the velocity.
ImuSample Predicted(Timestamp stamp, const NavState& state, const Vector3& w_imu_radps) {
  const Vector3 v_imu_mps = state.T_world_imu.rotation.conjugate() * state.v_world_imu;
  ImuSample sample = Rate(stamp, w_imu_radps);
  sample.f_imu_mps2 = (w_imu_radps - state.gyro_bias).cross(v_imu_mps);
  return sample;
}

}  // namespace

ConstantVelocityTracker::ConstantVelocityTracker(Timestamp start, const TrackerOptions& options)
    : history_options_(MakeHistoryOptions(options)),
      has_gyro_(options.first_rate_radps.has_value()),
      follows_turns_(options.follows_turns),
      last_rate_(options.first_rate_radps.value_or(Vector3::Zero())),
      turn_error_var_(std::pow(
          kConstantVelocity.start_turn_accel_density / kConstantVelocity.density_per_error, 2)),
      history_(history_options_, Start(start, options), Rate(start, last_rate_)) {
  if (follows_turns_) history_ = {history_options_, history_.head(), SampleNow()};
}

void ConstantVelocityTracker::AddRate(const ImuSample& sample) {
  if (!has_gyro_ || sample.stamp <= history_.head().stamp) return;
  last_rate_ = sample.w_imu_radps;
  ImuSample now = SampleNow();
  now.stamp = sample.stamp;
  // The history cannot refuse it: it is newer than all that came.
  (void)history_.AddImu(now);
}

void ConstantVelocityTracker::AdvanceTo(Timestamp stamp) {
  if (stamp - history_.head().stamp > kConstantVelocity.max_unseen) {
    SetClock(stamp - kSweep.max_span);
  }
  Timestamp at = history_.head().stamp;
  const Timestamp follows_turn_until = at + kConstantVelocity.follows_turn_for;
  while (at < stamp) {
    at = std::min(at + kConstantVelocity.step, stamp);
    // The history cannot refuse it: it is newer than all that came.
    ImuSample sample = SampleNow();
    sample.stamp = at;
    if (at > follows_turn_until) sample.f_imu_mps2.setZero();
    (void)history_.AddImu(sample);
  }
}

ImuSample ConstantVelocityTracker::SampleNow() const {
  const Estimate& head = history_.head();
  return follows_turns_ ? Predicted(head.stamp, head.state, last_rate_)
                        : Rate(head.stamp, last_rate_);
}

bool ConstantVelocityTracker::AddMatch(Timestamp middle, const MatchResult& match) {
  if (match.IsUsable()) {
    PoseEvent event;
    event.measurement.T_map_imu = match.T_map_imu;
    event.measurement.cov = MatchCov(middle, match);
    event.force = true;
    return history_.AddPose(middle, event) == EventOutcome::kApplied;
  }
  return match.status == MatchStatus::kEmptyMap &&
         history_.AddRebase(middle) == EventOutcome::kApplied;
}

Matrix6 ConstantVelocityTracker::MatchCov(Timestamp middle, const MatchResult& match) const {
  return WithBlindErrors(match, history_.At(middle).cov.block<6, 6>(kMapPose, kMapPose));
}

void ConstantVelocityTracker::NoteTurnError(double error_rad, double since_s) {
  if (!follows_turns_ || has_gyro_) return;
  const double var = error_rad * error_rad / (since_s * since_s * since_s);
  turn_error_var_ += kConstantVelocity.turn_error_rate * (var - turn_error_var_);
  history_options_.noise.gyro_bias_walk_density = std::clamp(
      kConstantVelocity.density_per_error * std::sqrt(turn_error_var_),
      kConstantVelocity.min_turn_accel_density, kConstantVelocity.max_turn_accel_density);
  history_.SetBiasWalk(history_options_.noise.gyro_bias_walk_density);
}

Estimate ConstantVelocityTracker::AtEnd(Timestamp middle, Timestamp end,
                                        const std::optional<TurnRate>& shown) const {
  if (!shown || has_gyro_) return history_.At(end);
  Estimate estimate = history_.At(middle);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(3, kStateDim);
  H.middleCols<3>(kGyroBias) = -Matrix3::Identity();
  FuseLinear(estimate, H, shown->w_imu_radps + estimate.state.gyro_bias, shown->cov);
  Propagate(estimate, Predicted(middle, estimate.state, last_rate_),
            Predicted(end, estimate.state, last_rate_), history_options_.noise,
            history_options_.g_world);
  estimate.stamp = end;
  return estimate;
}

void ConstantVelocityTracker::SetClock(Timestamp stamp) {
  Estimate estimate = history_.head();
  estimate.stamp = stamp;
  AllowUnseenHalfSecond(estimate);
  history_ = FilterHistory(history_options_, estimate, Rate(stamp, last_rate_));
}

}  // namespace lio
