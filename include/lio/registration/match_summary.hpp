// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// From the terms of a least-squares match at its solution to what is reported: information,
// covariance, weak directions. One term is w (n . e(T))^2 / 2 with e a point's offset on the map, n
// a unit direction of the map and w a robust weight held constant.
#pragma once

#include "lio/registration/cluster_scores.hpp"
#include "lio/registration/degenerate_directions.hpp"
#include "lio/registration/scan_matcher.hpp"

namespace lio {

using Vector6f = Eigen::Matrix<float, 6, 1>;

// Derivative of n . (T p) by the right perturbation of T, for n given in the imu's axes.
inline Vector6f JacobianRow(const Eigen::Vector3f& p, const Eigen::Vector3f& n) {
  Vector6f row;  // [n; p x n], both in the imu's axes
  row << n.x(), n.y(), n.z(), p.y() * n.z() - p.z() * n.y(), p.z() * n.x() - p.x() * n.z(),
      p.x() * n.y() - p.y() * n.x();
  return row;
}

// Geman-McClure's kernel at a residual of so many sigmas, squared: w = 1 / (1 + d^2/8)^2.
class RobustKernel {
 public:
  RobustKernel() = default;
  explicit RobustKernel(float distance_sq) : root_(1.f / (1.f + distance_sq / kWidthSq)) {
    // d(w d)/dd over w: less than one, for the kernel gives way.
    curvature_ = 1.f - 4.f * root_ * distance_sq / kWidthSq;
  }
  float weight() const { return root_ * root_; }  // 1 for an inlier
  float curvature() const { return curvature_; }

  // Beyond five sigma a residual does not count at all.
  static bool IsOutlier(float distance_sq) { return distance_sq > 25.f; }

 private:
  static constexpr float kWidthSq = 8.f;

  float root_ = 0.f;
  float curvature_ = 0.f;
};

// The lower triangle alone is added to; symmetric when read.
class TermSum {
 public:
  void Add(const Vector6f& row, float weight) {
    const Vector6f weighted = weight * row;
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j <= i; ++j) sum_(i, j) += static_cast<double>(weighted[i] * row[j]);
    }
  }
  void operator+=(const TermSum& other) { sum_ += other.sum_; }
  Matrix6 Full() const { return sum_.selfadjointView<Eigen::Lower>(); }

 private:
  Matrix6 sum_ = Matrix6::Zero();
};

// Sums over terms, in the order they are added.
struct MatchSums {
  // One row of the problem, of this weight [1/m^2], the kernel's part included. Gives its gradient.
  Vector6f AddRow(const Vector6f& row, float residual_m, float weight, const RobustKernel& kernel);
  void operator+=(const MatchSums& other);
  // The robust cost's own curvature over that of the one with weights held: below one.
  double curvature_ratio() const;

  TermSum information;
  TermSum noise_information;  // information that the noise of the map's directions alone would show
  Vector6 gradient = Vector6::Zero();
  double weight_sum = 0.0;       // of the robust weights, 1 for an inlier
  double residual_sq_sum = 0.0;  // weighted so [m^2]
  double curvature_sum = 0.0;    // of the robust cost, and ...
  double information_sum = 0.0;  // ... of the one with weights held
  int num_matched = 0;
};

DirectionSplit SplitDirections(const MatchSums& sums);

// `score_cov`: of the whole gradient. Fills information, covariances, eigenvalues, weak directions
// and residual; turns kConverged into kDegenerate where a direction is weak. Gives the step that is
// left, within the held directions.
Vector6 Summarise(const MatchSums& sums, const Matrix6& score_cov, MatchResult& result);

// The step that Summarise() gave costs nothing, and iterations stop at a finite one: moves the
// result by it unless it is no small one.
void TakeLastStep(const Vector6& step, MatchResult& result);

}  // namespace lio
