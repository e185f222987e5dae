// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/match_summary.hpp"

#include <algorithm>
#include <cmath>

#include "lio/base/chi_square.hpp"

namespace lio {
namespace {

std::vector<BlindDirection> BlindDirectionsOf(const DirectionSplit& split) {
  std::vector<BlindDirection> directions;
  const Vector6 scale = split.Scale();
  for (int i = 0; i < 6; ++i) {
    if (!split.IsDegenerate(i)) continue;
    const Vector6 direction = split.directions.col(i);
    directions.push_back({direction.cwiseQuotient(scale), direction.cwiseProduct(scale)});
  }
  return directions;
}

}  // namespace

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
  noise_information += other.noise_information;
  sure_information += other.sure_information;
  gradient += other.gradient;
  weight_sum += other.weight_sum;
  residual_sq_sum += other.residual_sq_sum;
  curvature_sum += other.curvature_sum;
  information_sum += other.information_sum;
  num_matched += other.num_matched;
}

double MatchSums::curvature_ratio() const {
  return std::clamp(curvature_sum / information_sum, MatchParameters::kMinCurvatureRatio, 1.0);
}

DirectionSplit SplitDirections(const MatchSums& sums) {
  return SplitDirections(sums.information.Full(), sums.noise_information.Full(),
                         sums.sure_information.Full());
}

SolvedSums Summarise(const MatchSums& sums, const Matrix6& score_cov, MatchResult& result) {
  result.information = sums.information.Full();
  result.observability.counted =
      CountedInformation(result.information, sums.sure_information.Full());
  result.observability.noise = sums.noise_information.Full();
  const DirectionSplit split = SplitDirections(sums);
  // The sandwich is made with the robust cost's own curvature, which is less than the information.
  const double curvature = sums.curvature_ratio();
  result.eigenvalues = split.eigenvalues;
  result.degenerate_mask = split.degenerate_mask;
  result.blind_directions = BlindDirectionsOf(split);
  const Matrix6 inverse = ObservableInverse(split);
  result.shift_per_score = inverse / curvature;
  result.observable_cov = CovarianceFromScores(result.shift_per_score, score_cov);
  result.cov = result.observable_cov + DegenerateCovariance(split);
  result.residual_rms_m = std::sqrt(sums.residual_sq_sum / sums.weight_sum);
  if (split.degenerate_mask != 0 && result.status == MatchStatus::kConverged) {
    result.status = MatchStatus::kDegenerate;
  }
  return {inverse, -inverse * sums.gradient};
}

void TakeLastStep(const Vector6& step, MatchResult& result) {
  if (step.norm() < MatchParameters::kMaxLastStep)
    result.T_map_imu = result.T_map_imu * ExpSe3(step);
}

void MatchScores::Reset(std::size_t num_parts, const Pose& T_imu_lidar) {
  by_part_.Reset(num_parts);
  along_.Reset(num_parts);
  by_beam_.Reset(T_imu_lidar);
  rows_.clear();
}

void MatchScores::Add(const Eigen::Vector3f& point_imu, const ScoredRow& row) {
  by_part_.Add(row.part, row.score);
  by_beam_.Add(point_imu, row.score);
  rows_.push_back(row);
}

void MatchScores::Complete(double curvature_ratio, MatchResult& result) {
  result.beam_pull.scores = by_beam_.ByDirection();
  for (BlindDirection& blind : result.blind_directions) {
    const Vector6f shift = blind.shift.cast<float>();
    along_.Reset(0);
    for (const ScoredRow& row : rows_) {
      along_.Add(row.part, row.weight * row.jacobian.dot(shift) * row.jacobian);
    }
    blind.cov = CovarianceFromScores(curvature_ratio * result.shift_per_score, along_.Covariance());
  }
}

void FinishMatch(const MatchSums& sums, MatchScores& scores, bool has_enough, MatchResult& result) {
  result.num_matched = sums.num_matched;
  if (!has_enough) {
    result.status = MatchStatus::kTooFewPoints;
    return;
  }
  TakeLastStep(Summarise(sums, scores.Covariance(), result).last_step, result);
  scores.Complete(sums.curvature_ratio(), result);
}

bool ContradictsGuess(const MatchResult& result, const MatchInput& input) {
  if (!result.IsUsable()) return false;
  static const double limit = ChiSquareQuantile6(MatchParameters::kAgreementProbability);
  const Vector6 shift = LogSe3(input.T_map_imu_guess.Inverse() * result.T_map_imu);
  const Matrix6 cov = input.guess_cov + result.cov;
  return shift.dot(cov.ldlt().solve(shift)) > limit;
}

}  // namespace lio
