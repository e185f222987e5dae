// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/sensor_fixed_errors.hpp"

#include <algorithm>

#include "lio/registration/degenerate_directions.hpp"

namespace lio {

void SensorFixedErrors::Add(const MatchResult& match) {
  const std::vector<Vector6>& scores = match.beam_scores;
  if (scores.empty()) return;
  mean_scores_.resize(scores.size(), Vector6::Zero());
  num_scans_ = std::min(num_scans_ + 1, kSensorFixedErrors.num_scans);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    mean_scores_[i] += (scores[i] - mean_scores_[i]) / num_scans_;
  }
}

Matrix6 SensorFixedErrors::CovOf(const MatchResult& match) const {
  Matrix6 sum = Matrix6::Zero();
  for (const Vector6& mean : mean_scores_) sum += mean * mean.transpose();
  return CovarianceFromScores(match.shift_per_score, sum);
}

}  // namespace lio
