// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "pipeline/sensor_fixed_errors.hpp"

#include "lio/registration/degenerate_directions.hpp"

namespace lio {

void SensorFixedErrors::Add(const MatchResult& match) {
  const std::vector<Vector6>& scores = match.beam_pull.scores;
  const double share = match.new_content_share;
  if (scores.empty() || !(share > 0.0)) return;
  mean_scores_.resize(scores.size(), Vector6::Zero());
  num_replacements_ += share;
  sum_of_shares_ += share;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    mean_scores_[i] += share / sum_of_shares_ * (scores[i] - mean_scores_[i]);
  }
}

void SensorFixedErrors::SetImu(const Pose& T_old_new) {
  const Matrix6 to_new = AdjointSe3(T_old_new).transpose();
  for (Vector6& mean : mean_scores_) mean = to_new * mean;
}

Matrix6 SensorFixedErrors::CovPerReplacement(const MatchResult& match) const {
  Matrix6 sum = Matrix6::Zero();
  for (const Vector6& mean : mean_scores_) sum += mean * mean.transpose();
  if (match.beam_pull.unknown_cov) sum = 0.5 * (sum + *match.beam_pull.unknown_cov);
  return 2.0 * num_replacements_ * CovarianceFromScores(match.shift_per_score, sum);
}

}  // namespace lio
