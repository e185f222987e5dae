// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/blind_axis.hpp"

#include <cmath>

#include "lio/registration/registration_parameters.hpp"

namespace lio {
namespace {

constexpr double kBlindVar_m2 =
    DegeneracyParameters::kDegenerateStd_m * DegeneracyParameters::kDegenerateStd_m;

// Something besides the match, such as standing things seen from above, may hold the direction.
bool IsHeld(const MatchResult& match, const Vector6& weight) {
  return weight.dot(match.cov * weight) < 0.5 * kBlindVar_m2;
}

}  // namespace

Matrix6 BlindAxis::CovOf(const MatchResult& match) {
  Transport(match.T_map_imu);
  if (match.blind_directions.empty() && SeesNoMoreThanBefore(match)) {
    return match.cov + BlindCov();
  }
  if (match.blind_directions.size() != 1 || match.blind_directions.front().cov.isZero(0.0)) {
    mean_.reset();
    return match.cov;
  }
  const BlindDirection& measured = match.blind_directions.front();
  Take(measured, measured.shift.dot(match.information * measured.shift));
  return IsHeld(match, measured.weight) ? match.cov : match.observable_cov + BlindCov();
}

void BlindAxis::Transport(const Pose& T_map_imu) {
  const Pose motion = T_map_imu_.Inverse() * T_map_imu;
  T_map_imu_ = T_map_imu;
  if (!mean_) return;
  const Matrix6 along = AdjointSe3(motion.Inverse());
  mean_->shift = along * mean_->shift;
  mean_->cov = (along * mean_->cov * along.transpose()).eval();
}

// The information that matches had while they were blind is the noise of this place.
bool BlindAxis::SeesNoMoreThanBefore(const MatchResult& match) const {
  return mean_ && mean_->shift.dot(match.information * mean_->shift) <
                      kBlindAxis.min_information_ratio * mean_->information;
}

Matrix6 BlindAxis::BlindCov() const {
  return kBlindVar_m2 * mean_->shift * mean_->shift.transpose();
}

// Fuses two directions, of which only what lies across them is uncertain.
void BlindAxis::Take(const BlindDirection& measured, double information) {
  if (!mean_ || !Agrees(measured)) {
    mean_ = Mean{measured.shift, measured.cov, information};
    return;
  }
  const double kept = 1.0 - kBlindAxis.forgotten_share;
  const Vector6 apart = measured.shift - mean_->shift;
  const Matrix6 gain = Spread(measured).solve(mean_->cov).transpose();
  mean_->shift += gain * apart;
  const Matrix6 cov = mean_->cov - gain * mean_->cov;
  mean_->cov = 0.5 / kept * (cov + cov.transpose());
  mean_->information += kBlindAxis.forgotten_share * (information - mean_->information);
}

// Gives the mean the length and the sign of the measured one, and compares them.
bool BlindAxis::Agrees(const BlindDirection& measured) {
  const double length = measured.weight.dot(mean_->shift);
  if (std::abs(length) < kBlindAxis.min_length) return false;
  mean_->shift /= length;
  mean_->cov /= length * length;
  const Vector6 apart = measured.shift - mean_->shift;
  return apart.dot(Spread(measured).solve(apart)) < kBlindAxis.max_chi_square;
}

// The covariance of the difference, filled up along the direction, where there is none.
Eigen::LDLT<Matrix6> BlindAxis::Spread(const BlindDirection& measured) const {
  const Matrix6 both = mean_->cov + measured.cov;
  return Eigen::LDLT<Matrix6>(both + both.trace() * measured.shift * measured.shift.transpose());
}

}  // namespace lio
