// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/match_summary.hpp"

#include <algorithm>
#include <cmath>

namespace lio {
namespace {

constexpr double kMinCurvature = 0.3;  // of the information; lower is a scene of outliers

}  // namespace

void ClusterScores::Reset(std::size_t num_parts) {
  for (const std::int32_t part : parts_) is_used_[static_cast<std::size_t>(part)] = 0;
  parts_.clear();
  if (by_part_.size() < num_parts) {
    by_part_.resize(num_parts);
    is_used_.resize(num_parts, 0);
  }
}

void ClusterScores::Add(std::int32_t part, const Vector6f& score) {
  const auto i = static_cast<std::size_t>(part);
  if (!is_used_[i]) {
    is_used_[i] = 1;
    by_part_[i].setZero();
    parts_.push_back(part);
  }
  by_part_[i] += score;
}

Matrix6 ClusterScores::SumOfSquares() const {
  Matrix6 sum = Matrix6::Zero();
  for (const std::int32_t part : parts_) {
    const Vector6 score = by_part_[static_cast<std::size_t>(part)].cast<double>();
    sum += score * score.transpose();
  }
  return sum;
}

Matrix6 ClusterScores::Covariance() const {
  const auto num_parts = static_cast<double>(parts_.size());
  return num_parts / std::max(1.0, num_parts - 6.0) * SumOfSquares();
}

Vector6f MatchSums::AddRow(const Vector6f& row, float residual_m, float weight,
                           const RobustKernel& kernel) {
  const Vector6f row_gradient = (weight * residual_m) * row;
  information.Add(row, weight);
  gradient += row_gradient.cast<double>();
  curvature_sum += weight * kernel.curvature();
  information_sum += weight;
  weight_sum += kernel.weight();
  residual_sq_sum += kernel.weight() * residual_m * residual_m;
  return row_gradient;
}

void MatchSums::operator+=(const MatchSums& other) {
  information += other.information;
  feigned += other.feigned;
  gradient += other.gradient;
  weight_sum += other.weight_sum;
  residual_sq_sum += other.residual_sq_sum;
  curvature_sum += other.curvature_sum;
  information_sum += other.information_sum;
  num_matched += other.num_matched;
}

DirectionSplit SplitDirections(const MatchSums& sums) {
  return SplitDirections(sums.information.Full(), sums.feigned.Full());
}

Vector6 Summarise(const MatchSums& sums, const Matrix6& score_cov, MatchResult& result) {
  result.information = sums.information.Full();
  const DirectionSplit split = SplitDirections(sums);
  // The sandwich wants the robust cost's own curvature, which is less than the information.
  const double curvature =
      std::clamp(sums.curvature_sum / sums.information_sum, kMinCurvature, 1.0);
  result.eigenvalues = split.eigenvalues;
  result.weak_mask = split.weak_mask;
  result.held_cov = CovarianceFromScores(split, score_cov / (curvature * curvature));
  result.cov = result.held_cov + WeakCovariance(split);
  result.residual_rms_m = std::sqrt(sums.residual_sq_sum / sums.weight_sum);
  if (split.weak_mask != 0 && result.status == MatchStatus::kConverged) {
    result.status = MatchStatus::kDegenerate;
  }
  return StepInHeldDirections(split, sums.gradient);
}

void TakeLastStep(const Vector6& step, MatchResult& result) {
  constexpr double kMaxLastStep = 5e-3;  // m, rad
  if (step.norm() < kMaxLastStep) result.T_map_imu = result.T_map_imu * ExpSe3(step);
}

}  // namespace lio
