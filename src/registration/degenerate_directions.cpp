// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/degenerate_directions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>

#include "lio/registration/registration_parameters.hpp"

namespace lio {
namespace {

// Sure information needs no margin above the noise: it counts as many times as the threshold says.
constexpr double kMoreForSure = DegeneracyParameters::kMinInformationRatio - 1.0;

// How many directions have less information than the threshold times what noise induces, and an
// orthonormal basis whose first columns span them. The ratio's extremes are the generalised
// eigenvalues of the two matrices: eigenvectors of the information alone mix a degenerate direction
// with another one of the same information.
struct Subspaces {
  int num_degenerate = 0;
  Matrix6 basis = Matrix6::Identity();
};

Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6> RatiosOf(const Matrix6& information,
                                                           const Matrix6& noise) {
  const double floor = DegeneracyParameters::kRegularization * information.trace();
  return {information, noise + floor * Matrix6::Identity()};
}

Subspaces FindSubspaces(const Matrix6& information, const Matrix6& noise) {
  Subspaces found;
  if (!(information.trace() > 0.0)) {
    found.num_degenerate = 6;
    return found;
  }
  const auto ratios = RatiosOf(information, noise);
  while (found.num_degenerate < 6 && !(ratios.eigenvalues()[found.num_degenerate] >
                                       DegeneracyParameters::kMinInformationRatio)) {
    ++found.num_degenerate;
  }
  // The eigenvectors ascend with the ratio; those of the degenerate directions come first.
  const Eigen::HouseholderQR<Matrix6> qr(ratios.eigenvectors());
  found.basis = qr.householderQ();
  return found;
}

// Fills eigenvalues and directions of the information within the subspace of `count` columns of
// the basis from `begin` on.
void SplitWithin(const Matrix6& information, const Matrix6& basis, int begin, int count,
                 DirectionSplit& split) {
  if (count == 0) return;
  const Eigen::MatrixXd part = basis.middleCols(begin, count);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(part.transpose() * information * part);
  split.eigenvalues.segment(begin, count) = eigen.eigenvalues();
  split.directions.middleCols(begin, count) = part * eigen.eigenvectors();
}

}  // namespace

double MetresPerRad(const Matrix6& information) {
  const double rotation = information.bottomRightCorner<3, 3>().trace();
  const double translation = information.topLeftCorner<3, 3>().trace();
  return translation > 0 && rotation > 0 ? std::sqrt(rotation / translation) : 1.0;
}

DirectionSplit SplitDirections(const Matrix6& information, const Matrix6& noise_information,
                               const Matrix6& sure_information) {
  DirectionSplit split;
  split.metres_per_rad = MetresPerRad(information);
  const Vector6 inverse_scale = split.Scale().cwiseInverse();
  const auto in_metres = [&](const Matrix6& matrix) -> Matrix6 {
    return inverse_scale.asDiagonal() * matrix * inverse_scale.asDiagonal();
  };
  const Matrix6 scaled = in_metres(information);
  const Subspaces found = FindSubspaces(scaled + kMoreForSure * in_metres(sure_information),
                                        in_metres(noise_information));
  SplitWithin(scaled, found.basis, 0, found.num_degenerate, split);
  SplitWithin(scaled, found.basis, found.num_degenerate, 6 - found.num_degenerate, split);
  split.degenerate_mask = (1u << found.num_degenerate) - 1u;
  return split;
}

double LeastInformationRatio(const Matrix6& information, const Matrix6& noise_information) {
  if (!(information.trace() > 0.0)) return 0.0;
  return RatiosOf(information, noise_information).eigenvalues()[0];
}

Matrix6 CountedInformation(const Matrix6& information, const Matrix6& sure_information) {
  return information + kMoreForSure * sure_information;
}

Matrix6 ObservableInverse(const DirectionSplit& split) {
  Matrix6 inverse = Matrix6::Zero();
  for (int i = 0; i < 6; ++i) {
    if (split.IsDegenerate(i)) continue;
    const Vector6 v = split.directions.col(i);
    inverse += v * v.transpose() / split.eigenvalues[i];
  }
  const Vector6 inverse_scale = split.Scale().cwiseInverse();
  return inverse_scale.asDiagonal() * inverse * inverse_scale.asDiagonal();
}

Vector6 StepInObservableDirections(const DirectionSplit& split, const Vector6& gradient) {
  return -ObservableInverse(split) * gradient;
}

Vector6 StepTowardsGuess(const Matrix6& information, const Vector6& gradient,
                         const FromGuess& from_guess) {
  const Matrix6 prior = from_guess.guess_cov.inverse();
  return -(information + prior).ldlt().solve(gradient + prior * LogSe3(from_guess.T_guess_imu));
}

Vector6 KeepObservableDirections(const DirectionSplit& split, const Vector6& step) {
  const Vector6 scale = split.Scale();
  Vector6 scaled = scale.cwiseProduct(step);
  for (int i = 0; i < 6; ++i) {
    if (!split.IsDegenerate(i)) continue;
    const Vector6 v = split.directions.col(i);
    scaled -= v * v.dot(scaled);
  }
  return scale.cwiseInverse().cwiseProduct(scaled);
}

Matrix6 CovarianceFromScores(const Matrix6& inverse, const Matrix6& score_cov) {
  const Matrix6 cov = inverse * score_cov * inverse;
  return 0.5 * (cov + cov.transpose());
}

Matrix6 DegenerateCovariance(const DirectionSplit& split) {
  constexpr double kStd_m = DegeneracyParameters::kDegenerateStd_m;
  const Vector6 inverse_scale = split.Scale().cwiseInverse();
  Matrix6 cov = Matrix6::Zero();
  for (int i = 0; i < 6; ++i) {
    if (!split.IsDegenerate(i)) continue;
    const Vector6 v = inverse_scale.cwiseProduct(split.directions.col(i));
    cov += kStd_m * kStd_m * v * v.transpose();
  }
  return cov;
}

}  // namespace lio
