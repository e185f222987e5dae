// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Which directions of a pose does a scene hold? The noise of a map's normals alone feigns
// information along every direction, so a direction counts as held only when its information is
// well above what that noise would give (docs/filter.md). No tuned eigenvalue threshold.
#pragma once

#include "lio/base/pose.hpp"

namespace lio {

struct DirectionSplit {
  double metres_per_rad = 1.0;            // lever that makes rotations comparable to translations
  Vector6 eigenvalues = Vector6::Zero();  // of the scaled information, ascending
  Matrix6 directions = Matrix6::Identity();  // columns, scaled coordinates
  unsigned degenerate_mask = 0;              // bit i: direction i is weak

  int num_degenerate() const { return __builtin_popcount(degenerate_mask); }
  // Scales [translation; rotation] to metres.
  Vector6 Scale() const {
    Vector6 scale;
    scale << Vector3::Ones(), Vector3::Constant(metres_per_rad);
    return scale;
  }
};

// `noise_information`: information that normals of no accuracy better than their own would show.
DirectionSplit SplitDirections(const Matrix6& information, const Matrix6& noise_information);

// The Gauss-Newton step -H^-1 g within the held directions, [translation; rotation].
Vector6 StepInObservableDirections(const DirectionSplit& split, const Vector6& gradient);

// A step without its part along the weak directions, [translation; rotation].
Vector6 KeepObservableDirections(const DirectionSplit& split, const Vector6& step);

// H^-1 S H^-1 within the held directions, zero along the weak ones.
Matrix6 CovarianceFromScores(const DirectionSplit& split, const Matrix6& score_cov);

// A variance of (100 m)^2 along the weak directions, zero along the held ones.
Matrix6 DegenerateCovariance(const DirectionSplit& split);

}  // namespace lio
