// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/intra_sweep_rate_estimator.hpp"

#include <Eigen/Cholesky>

#include "lio/registration/registration_parameters.hpp"

namespace lio {

void IntraSweepRateEstimator::Reset(std::size_t num_parts) {
  information_.setZero();
  gradient_.setZero();
  scores_.Reset(num_parts);
}

void IntraSweepRateEstimator::Add(std::int32_t part, const PoseScores::Score& row, float residual_m,
                                  float weight, float from_mid_sweep_s) {
  ClusterScores<kDims>::Score full;
  full << row, from_mid_sweep_s * row.tail<3>();
  const Eigen::Matrix<double, kDims, 1> wide = full.cast<double>();
  information_ += weight * wide * wide.transpose();
  gradient_ += weight * residual_m * wide;
  scores_.Add(part, weight * residual_m * full);
}

TurnRate IntraSweepRateEstimator::Solve(double curvature_ratio) const {
  Eigen::Matrix<double, kDims, 1> prior_std;
  prior_std << Vector3::Constant(IntraSweepRateParameters::kPoseStd_m),
      Vector3::Constant(IntraSweepRateParameters::kPoseStd_rad),
      Vector3::Constant(IntraSweepRateParameters::kRateStd_radps);
  const Eigen::Matrix<double, kDims, 1> prior = prior_std.cwiseAbs2().cwiseInverse();
  Eigen::Matrix<double, kDims, kDims> information = information_;
  information.diagonal() += prior;
  Eigen::Matrix<double, kDims, kDims> spread =
      scores_.Covariance() / (curvature_ratio * curvature_ratio);
  spread.diagonal() += prior;

  const Eigen::Matrix<double, kDims, kDims> inverse =
      information.ldlt().solve(Eigen::Matrix<double, kDims, kDims>::Identity());
  TurnRate error;
  error.w_imu_radps = -(inverse * gradient_).tail<3>();
  error.cov = (inverse * spread * inverse).bottomRightCorner<3, 3>();
  return error;
}

}  // namespace lio
