// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/filter/steady_world.hpp"

#include <algorithm>
#include <cmath>

namespace lio {
namespace {

constexpr double kUnknownTiltStd_rad = 0.0075;  // above this the start still finds its level
constexpr double kSureInStd = 2.0;
constexpr double kTurnPerScan_rad = 5e-4;

// Standard deviation of the larger tilt, about the world's horizontal axes.
double TiltStd(const Estimate& estimate) {
  const Matrix3 R = estimate.state.T_world_imu.rotation.toRotationMatrix();
  const Matrix3 cov = R * estimate.cov.block<3, 3>(kRot, kRot) * R.transpose();
  return std::sqrt(std::max(cov(0, 0), cov(1, 1)));
}

}  // namespace

void SteadyWorld::Update(const Estimate& estimate) {
  const Pose& T_filter_imu = estimate.state.T_world_imu;
  const Pose T_filter_map = T_filter_imu * estimate.state.T_map_imu.Inverse();
  const double tilt_std = TiltStd(estimate);
  if (mode_ == Mode::kFromMotion && tilt_std < kUnknownTiltStd_rad) mode_ = Mode::kFromRest;
  if (!T_world_map_ || mode_ != Mode::kFromRest) {
    T_world_map_ = T_filter_map;
    return;
  }
  // The turn that would level what is published, about horizontal axes only.
  Vector3 turn = LogSo3(T_filter_map.rotation * T_world_map_->rotation.conjugate());
  turn.z() = 0.0;
  const double off = turn.norm();
  const double too_far = off - std::max(kTolerance_rad, kSureInStd * tilt_std);
  if (too_far <= 0.0) return;
  const Vector3 step = std::min(kTurnPerScan_rad, too_far) / off * turn;
  const Vector3 pivot = (*T_world_map_ * estimate.state.T_map_imu).translation;
  const Quaternion rotation = ExpSo3(step);
  T_world_map_ = Pose{rotation, pivot - rotation * pivot} * *T_world_map_;
}

SteadyWorld::Published SteadyWorld::Publish(const Estimate& estimate) const {
  const NavState& state = estimate.state;
  Published published;
  published.cov = estimate.cov.topLeftCorner<kAccelBias, kAccelBias>();
  if (!T_world_map_) {
    published.T_world_imu = state.T_world_imu;
    published.v_world_imu = state.v_world_imu;
    return published;
  }
  published.T_world_imu = *T_world_map_ * state.T_map_imu;
  const Quaternion turn = published.T_world_imu.rotation * state.T_world_imu.rotation.conjugate();
  published.v_world_imu = turn * state.v_world_imu;
  // What is published differs from the best estimate by a known step: its mean square is the
  // variance plus the step's square.
  Eigen::Matrix<double, kAccelBias, 1> step;
  step << state.T_world_imu.translation - published.T_world_imu.translation,
      LogSo3(published.T_world_imu.rotation.conjugate() * state.T_world_imu.rotation),
      state.v_world_imu - published.v_world_imu, Vector3::Zero();
  published.cov += step * step.transpose();
  return published;
}

}  // namespace lio
