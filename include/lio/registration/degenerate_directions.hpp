// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Which directions of a pose does a match observe? The noise of a map's normals alone induces
// information along every direction, so a direction counts as observable only when its information
// is well above that noise-induced information; the others are degenerate. Steps and covariances
// are then restricted to the observable directions. Source: Zhang, Kaess, Singh, "On Degeneracy of
// Optimization-based State Estimation Problems", ICRA 2016, for the eigenvectors of the information
// and the projected step (solution remapping). Differences: rotations are scaled to metres first,
// the threshold is the noise-induced information of each direction and no tuned eigenvalue, and the
// degenerate directions are generalised eigenvectors of information and noise.
#pragma once

#include "lio/base/pose.hpp"

namespace lio {

struct DirectionSplit {
  double metres_per_rad = 1.0;  // scales rotations to the size of translations
  // Holds the eigenvalues of the scaled information: those of degenerate directions first, either
  // part ascends.
  Vector6 eigenvalues = Vector6::Zero();
  Matrix6 directions = Matrix6::Identity();  // columns, scaled coordinates
  unsigned degenerate_mask = 0;              // bit i: direction i is degenerate

  int num_degenerate() const { return __builtin_popcount(degenerate_mask); }
  bool IsDegenerate(int direction) const { return (degenerate_mask >> direction & 1u) != 0; }
  // Scales [translation; rotation] to metres.
  Vector6 Scale() const {
    Vector6 scale;
    scale << Vector3::Ones(), Vector3::Constant(metres_per_rad);
    return scale;
  }
};

// Returns the root mean square of the levers at which the matched points hold the rotation: about
// as far as the surroundings are. 1 where there is no information.
[[nodiscard]] double MetresPerRad(const Matrix6& information);

// `information` is the Hessian of the cost, right error. `noise_information` is the part of it that
// the noise of the map's normals induces by itself. `sure_information`: the part of it that this
// noise does not induce; it needs no margin above the noise.
[[nodiscard]] DirectionSplit SplitDirections(const Matrix6& information,
                                             const Matrix6& noise_information,
                                             const Matrix6& sure_information = Matrix6::Zero());

// Returns the least ratio, over all directions, of information to that which noise induces.
[[nodiscard]] double LeastInformationRatio(const Matrix6& information,
                                           const Matrix6& noise_information);

// Returns the information that is compared with that which noise induces: the sure part counts as
// many times as the threshold says.
[[nodiscard]] Matrix6 CountedInformation(const Matrix6& information,
                                         const Matrix6& sure_information);

// Returns the Gauss-Newton step -H^-1 g within the observable directions, [translation; rotation].
[[nodiscard]] Vector6 StepInObservableDirections(const DirectionSplit& split,
                                                 const Vector6& gradient);

// Tells where a pose is, seen from its guess, whose covariance is positive definite (right error).
struct FromGuess {
  Pose T_guess_imu;
  Matrix6 guess_cov;
};

// Returns the Gauss-Newton step in all directions of the cost and a Gaussian prior at the guess,
// which holds what the cost leaves open, [translation; rotation]. Angles from the guess are small.
[[nodiscard]] Vector6 StepTowardsGuess(const Matrix6& information, const Vector6& gradient,
                                       const FromGuess& from_guess);

// Returns a step without its part along the degenerate directions, [translation; rotation].
[[nodiscard]] Vector6 KeepObservableDirections(const DirectionSplit& split, const Vector6& step);

// Returns the inverse of the information within the observable directions, zero along the
// degenerate ones.
[[nodiscard]] Matrix6 ObservableInverse(const DirectionSplit& split);

// Returns the sandwich H^-1 S H^-1, with the inverse as ObservableInverse() has it. S is the
// covariance of the gradient.
[[nodiscard]] Matrix6 CovarianceFromScores(const Matrix6& inverse, const Matrix6& score_cov);

// Returns a variance of (100 m)^2 along the degenerate directions, zero along the observable ones.
[[nodiscard]] Matrix6 DegenerateCovariance(const DirectionSplit& split);

}  // namespace lio
