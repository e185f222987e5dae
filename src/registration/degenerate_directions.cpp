// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/degenerate_directions.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "lio/registration/registration_parameters.hpp"

namespace lio {
DirectionSplit SplitDirections(const Matrix6& information, const Matrix6& noise_information) {
  DirectionSplit split;
  const double rotation = information.bottomRightCorner<3, 3>().trace();
  const double translation = information.topLeftCorner<3, 3>().trace();
  if (translation > 0 && rotation > 0) split.metres_per_rad = std::sqrt(rotation / translation);
  const Vector6 inverse_scale = split.Scale().cwiseInverse();
  const Matrix6 scaled = inverse_scale.asDiagonal() * information * inverse_scale.asDiagonal();
  const Matrix6 noise = inverse_scale.asDiagonal() * noise_information * inverse_scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(scaled);
  split.eigenvalues = eigen.eigenvalues();
  split.directions = eigen.eigenvectors();
  for (int i = 0; i < 6; ++i) {
    const Vector6 v = split.directions.col(i);
    const bool is_observable =
        split.eigenvalues[i] > 0 &&
        split.eigenvalues[i] > DegeneracyParameters::kMinInformationRatio * v.dot(noise * v);
    if (!is_observable) split.degenerate_mask |= 1u << i;
  }
  return split;
}

Vector6 StepInObservableDirections(const DirectionSplit& split, const Vector6& gradient) {
  const Vector6 inverse_scale = split.Scale().cwiseInverse();
  const Vector6 scaled_gradient = inverse_scale.cwiseProduct(gradient);
  Vector6 step = Vector6::Zero();
  for (int i = 0; i < 6; ++i) {
    if (split.degenerate_mask & (1u << i)) continue;
    const Vector6 v = split.directions.col(i);
    step -= v * (v.dot(scaled_gradient) / split.eigenvalues[i]);
  }
  return inverse_scale.cwiseProduct(step);
}

Vector6 KeepObservableDirections(const DirectionSplit& split, const Vector6& step) {
  const Vector6 scale = split.Scale();
  Vector6 scaled = scale.cwiseProduct(step);
  for (int i = 0; i < 6; ++i) {
    if (!(split.degenerate_mask & (1u << i))) continue;
    const Vector6 v = split.directions.col(i);
    scaled -= v * v.dot(scaled);
  }
  return scale.cwiseInverse().cwiseProduct(scaled);
}

Matrix6 CovarianceFromScores(const DirectionSplit& split, const Matrix6& score_cov) {
  const Vector6 inverse_scale = split.Scale().cwiseInverse();
  const Matrix6 scores = inverse_scale.asDiagonal() * score_cov * inverse_scale.asDiagonal();
  Matrix6 inverse = Matrix6::Zero();
  for (int i = 0; i < 6; ++i) {
    if (split.degenerate_mask & (1u << i)) continue;
    const Vector6 v = split.directions.col(i);
    inverse += v * v.transpose() / split.eigenvalues[i];
  }
  const Matrix6 scaled = inverse * scores * inverse;
  const Matrix6 cov = inverse_scale.asDiagonal() * scaled * inverse_scale.asDiagonal();
  return 0.5 * (cov + cov.transpose());
}

Matrix6 DegenerateCovariance(const DirectionSplit& split) {
  constexpr double kStd_m = DegeneracyParameters::kDegenerateStd_m;
  const Vector6 inverse_scale = split.Scale().cwiseInverse();
  Matrix6 cov = Matrix6::Zero();
  for (int i = 0; i < 6; ++i) {
    if (!(split.degenerate_mask & (1u << i))) continue;
    const Vector6 v = inverse_scale.cwiseProduct(split.directions.col(i));
    cov += kStd_m * kStd_m * v * v.transpose();
  }
  return cov;
}

}  // namespace lio
