// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/blind_axis.hpp"

#include <Eigen/Cholesky>
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

// Returns what the error of a direction adds to the covariance of a match.
Matrix6 ErrorOf(const BlindDirection& blind, const Matrix6& prior_cov, int num_alike) {
  return num_alike * blind.weight.dot(prior_cov * blind.weight) * blind.cov;
}

}  // namespace

Matrix6 WithBlindErrors(const MatchResult& match, const Matrix6& prior_cov, int num_alike) {
  Matrix6 cov = match.cov;
  for (const BlindDirection& blind : match.blind_directions) {
    cov += ErrorOf(blind, prior_cov, num_alike);
  }
  return cov;
}

BlindAxis::Answer BlindAxis::Judge(const MatchResult& match, const Matrix6& prior_cov) {
  Transport(match.T_map_imu);
  const bool is_blind = match.degenerate_mask != 0;
  blind_share_ += kBlindAxis.share_rate * ((is_blind ? 1.0 : 0.0) - blind_share_);
  const bool is_by_chance = !is_blind && IsBlindByChance(match);
  num_blind_ = is_blind || is_by_chance ? num_blind_ + 1 : 0;
  if (is_by_chance) return {match.cov + BlindCov(), true};
  if (match.blind_directions.size() != 1 || match.blind_directions.front().cov.isZero(0.0)) {
    if (is_blind || blind_share_ < 0.5) mean_.reset();
    return {WithBlindErrors(match, prior_cov, num_blind_), is_blind};
  }
  const BlindDirection& measured = match.blind_directions.front();
  Take(measured, match.observability.Ratio(measured.shift));
  if (IsHeld(match, measured.weight)) return {match.cov, true};
  return {match.observable_cov + BlindCov() + ErrorOf(measured, prior_cov, num_blind_), true};
}

void BlindAxis::Transport(const Pose& T_map_imu) {
  const Pose motion = T_map_imu_.Inverse() * T_map_imu;
  T_map_imu_ = T_map_imu;
  if (!mean_) return;
  const Matrix6 along = AdjointSe3(motion.Inverse());
  mean_->shift = along * mean_->shift;
  mean_->cov = (along * mean_->cov * along.transpose()).eval();
}

// The ratio that matches had while they were blind is the noise of this place.
bool BlindAxis::IsBlindByChance(const MatchResult& match) const {
  return mean_ && blind_share_ > 0.5 &&
         match.observability.Ratio(mean_->shift) <
             kBlindAxis.min_information_ratio * mean_->information_ratio;
}

Matrix6 BlindAxis::BlindCov() const {
  return kBlindVar_m2 * mean_->shift * mean_->shift.transpose();
}

void BlindAxis::Take(const BlindDirection& measured, double information_ratio) {
  if (mean_ && AlignTo(measured) && Fuse(measured, information_ratio)) return;
  mean_ = Mean{measured.shift, measured.cov, information_ratio};
}

// Gives the mean the length and the sign of the measured direction, unless it is another one.
bool BlindAxis::AlignTo(const BlindDirection& measured) {
  const double length = measured.weight.dot(mean_->shift);
  if (std::abs(length) < kBlindAxis.min_length) return false;
  mean_->shift /= length;
  const Matrix6 across =
      (Matrix6::Identity() - mean_->shift * measured.weight.transpose()) / length;
  mean_->cov = (across * mean_->cov * across.transpose()).eval();
  return true;
}

// Only what lies across the directions is uncertain, so that the covariance of their difference is
// filled up along them.
bool BlindAxis::Fuse(const BlindDirection& measured, double information_ratio) {
  const Vector6 apart = measured.shift - mean_->shift;
  const Matrix6 both = mean_->cov + measured.cov;
  const Eigen::LDLT<Matrix6> spread(both +
                                    both.trace() * measured.shift * measured.shift.transpose());
  if (!(apart.dot(spread.solve(apart)) < kBlindAxis.max_chi_square)) return false;
  const double kept = 1.0 - kBlindAxis.forgotten_share;
  const Matrix6 gain = spread.solve(mean_->cov).transpose();
  mean_->shift += gain * apart;
  const Matrix6 cov = mean_->cov - gain * mean_->cov;
  mean_->cov = 0.5 / kept * (cov + cov.transpose());
  mean_->information_ratio +=
      kBlindAxis.forgotten_share * (information_ratio - mean_->information_ratio);
  return true;
}

}  // namespace lio
