// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/constant_velocity_tracker.hpp"

#include <algorithm>

namespace lio {
namespace {

constexpr Duration kMaxUnseen{10'000'000'000};  // after more the clock was set, or all is new
constexpr Duration kMaxSweep{500'000'000};
constexpr Duration kStep{10'000'000};
constexpr double kAccelDensity = 1.5;      // m/s^2/sqrt(Hz): 0.5 m/s in a sweep of 0.1 s
constexpr double kTurnAccelDensity = 1.0;  // rad/s^2/sqrt(Hz): 0.3 rad/s in a sweep
constexpr double kStartVelocityStd_mps = 15.0;
constexpr double kStartTurnRateStd_radps = 1.0;
constexpr double kSoughtVelocityStd_mps = 1.5;
constexpr double kKnownVelocityStd_mps = 2.0;
constexpr double kKnownTurnRateStd_radps = 0.3;
constexpr double kUnseen_s = 0.5;
constexpr double kUnseenShift_m = 1.0;
constexpr double kUnseenTurn_rad = 0.2;
constexpr double kGyroDensity = 5.0e-3;  // rad/s/sqrt(Hz): also what scale and time errors do
constexpr double kGyroBiasStd_radps = 0.02;

HistoryOptions MakeHistoryOptions(const TrackerOptions& options) {
  HistoryOptions history;
  history.noise.accel_density = kAccelDensity;
  if (options.first_rate_radps) {
    history.noise.gyro_density = kGyroDensity;
  } else {
    history.noise.gyro_bias_walk_density = kTurnAccelDensity;
  }
  history.g_world = Vector3::Zero();
  history.span_s = options.span_s;
  history.nis_limit = options.nis_limit;
  history.max_inflation.translation = 1.0;  // the alignment judges that
  history.imu_outage.gap_s = 1e9;                   // its samples never have a gap
  return history;
}

Estimate Start(Timestamp start, const TrackerOptions& options) {
  Estimate estimate;
  estimate.stamp = start;
  const bool is_known = options.motion.has_value();
  double turn_rate_std_radps = is_known ? kKnownTurnRateStd_radps : kStartTurnRateStd_radps;
  if (options.first_rate_radps) turn_rate_std_radps = kGyroBiasStd_radps;
  double velocity_std_mps = is_known ? kKnownVelocityStd_mps : kStartVelocityStd_mps;
  if (!is_known && options.sought_v_imu_mps) {
    estimate.state.v_world_imu = *options.sought_v_imu_mps;
    velocity_std_mps = kSoughtVelocityStd_mps;
  }
  const auto set = [&](int at, double std) {
    estimate.cov.block<3, 3>(at, at) = std * std * Matrix3::Identity();
  };
  estimate.cov.topLeftCorner<6, 6>() = options.start_cov;
  set(kVel, velocity_std_mps);
  set(kGyroBias, turn_rate_std_radps);
  if (is_known) {
    const NavState& motion = *options.motion;
    estimate.state.v_world_imu = motion.T_world_imu.rotation.conjugate() * motion.v_world_imu;
    estimate.state.gyro_bias = motion.gyro_bias;
  }
  NavState& state = estimate.state;
  state.T_world_imu = options.T_world_start;
  state.T_map_imu = options.T_world_start;
  state.v_world_imu = options.T_world_start.rotation * state.v_world_imu;
  return estimate;
}

// For a while that nobody knows, about half a second.
void AllowUnseenHalfSecond(Estimate& estimate) {
  const double shift_std_m =
      std::max(kUnseenShift_m, kUnseen_s * estimate.state.v_world_imu.norm());
  Vector6 motion_var;
  motion_var << Vector3::Constant(shift_std_m * shift_std_m),
      Vector3::Constant(kUnseenTurn_rad * kUnseenTurn_rad);
  AllowUnseenMotion(estimate, motion_var,
                    Vector3::Constant(kKnownVelocityStd_mps * kKnownVelocityStd_mps));
}

ImuSample Rate(Timestamp stamp, const Vector3& w_imu_radps) {
  ImuSample sample;
  sample.stamp = stamp;
  sample.w_imu_radps = w_imu_radps;
  return sample;
}

}  // namespace

ConstantVelocityTracker::ConstantVelocityTracker(Timestamp start, const TrackerOptions& options)
    : history_options_(MakeHistoryOptions(options)),
      has_gyro_(options.first_rate_radps.has_value()),
      last_rate_(options.first_rate_radps.value_or(Vector3::Zero())),
      history_(history_options_, Start(start, options), Rate(start, last_rate_)) {}

void ConstantVelocityTracker::AddRate(const ImuSample& sample) {
  if (!has_gyro_ || sample.stamp <= history_.head().stamp) return;
  last_rate_ = sample.w_imu_radps;
  (void)history_.AddImu(Rate(sample.stamp, last_rate_));
}

void ConstantVelocityTracker::AdvanceTo(Timestamp stamp) {
  if (stamp - history_.head().stamp > kMaxUnseen) SetClock(stamp - kMaxSweep);
  Timestamp at = history_.head().stamp;
  while (at < stamp) {
    at = std::min(at + kStep, stamp);
    (void)history_.AddImu(Rate(at, last_rate_));
  }
}

void ConstantVelocityTracker::Tell(Timestamp middle, const MatchResult& match) {
  if (match.IsUsable()) {
    PoseEvent event;
    event.measurement.T_map_imu = match.T_map_imu;
    event.measurement.cov = match.cov;
    event.force = true;
    (void)history_.AddPose(middle, event);
  } else if (match.status == MatchStatus::kEmptyMap) {
    (void)history_.AddRebase(middle);
  }
}

Estimate ConstantVelocityTracker::AtEnd(Timestamp middle, Timestamp end,
                                        const std::optional<TurnRate>& shown) const {
  if (!shown || has_gyro_) return history_.At(end);
  Estimate estimate = history_.At(middle);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(3, kStateDim);
  H.middleCols<3>(kGyroBias) = -Matrix3::Identity();
  FuseLinear(estimate, H, shown->w_imu_radps + estimate.state.gyro_bias, shown->cov);
  Propagate(estimate, Rate(middle, Vector3::Zero()), Rate(end, Vector3::Zero()),
            history_options_.noise, history_options_.g_world);
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
