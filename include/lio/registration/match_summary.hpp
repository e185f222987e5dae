// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Turns the terms of a least-squares match at its solution into its report: information,
// covariance, degenerate directions. One term is w (n . e(T))^2 / 2 with e a point's offset on the
// map, n a unit direction of the map and w a robust weight that the derivative takes as constant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lio/registration/beam_scores.hpp"
#include "lio/registration/cluster_scores.hpp"
#include "lio/registration/degenerate_directions.hpp"
#include "lio/registration/registration_parameters.hpp"
#include "lio/registration/scan_matcher.hpp"

namespace lio {

// Returns the derivative of n . (T p) by the right perturbation of T, for n given in the imu's
// axes.
inline Vector6f JacobianRow(const Eigen::Vector3f& p, const Eigen::Vector3f& n) {
  Vector6f row;  // [n; p x n], both in the imu's axes
  row << n.x(), n.y(), n.z(), p.y() * n.z() - p.z() * n.y(), p.z() * n.x() - p.x() * n.z(),
      p.x() * n.y() - p.y() * n.x();
  return row;
}

// Geman-McClure's kernel, w = 1 / (1 + d^2/8)^2, at a residual of d standard deviations; functions
// take d^2. Source: Geman, McClure, Bull. Int. Stat. Inst. 52, 1987; Barron, "A General and
// Adaptive Robust Loss Function", CVPR 2019, for its place among others.
class RobustKernel {
 public:
  RobustKernel() = default;
  explicit RobustKernel(float distance_sq)
      : root_(1.f / (1.f + distance_sq / Parameters::kWidthSq)) {
    // d(w d)/dd over w: less than one, since the weight falls as the residual grows.
    curvature_ = 1.f - 4.f * root_ * distance_sq / Parameters::kWidthSq;
  }
  [[nodiscard]] float weight() const { return root_ * root_; }  // 1 for an inlier
  // Returns the robust cost's second derivative over the weight.
  [[nodiscard]] float curvature() const { return curvature_; }

  // Beyond five standard deviations a residual does not count at all.
  [[nodiscard]] static bool IsOutlier(float distance_sq) {
    return distance_sq > Parameters::kMaxDistanceSq;
  }

 private:
  using Parameters = RobustKernelParameters;

  float root_ = 0.f;
  float curvature_ = 0.f;
};

// A sum of weight row row^T. The lower triangle alone is summed; Full() is symmetric.
class TermSum {
 public:
  void Add(const Vector6f& row, float weight) {
    const Vector6f weighted = weight * row;
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j <= i; ++j) sum_(i, j) += static_cast<double>(weighted[i] * row[j]);
    }
  }
  void operator+=(const TermSum& other) { sum_ += other.sum_; }
  [[nodiscard]] Matrix6 Full() const { return sum_.selfadjointView<Eigen::Lower>(); }

 private:
  Matrix6 sum_ = Matrix6::Zero();
};

// Sums over terms, in the order they are added.
struct MatchSums {
  // Adds one row of the problem. `weight` [1/m^2] includes the kernel's. Returns the row's
  // gradient.
  Vector6f AddRow(const Vector6f& row, float residual_m, float weight, const RobustKernel& kernel);
  void operator+=(const MatchSums& other);
  // Returns the robust cost's own curvature over that of the cost with constant weights: below one.
  [[nodiscard]] double curvature_ratio() const;

  TermSum information;
  TermSum noise_information;  // the part that the noise of the map's normals induces by itself
  TermSum sure_information;   // the part that no noise of normals induces: of vertical structures
  Vector6 gradient = Vector6::Zero();
  double weight_sum = 0.0;       // sum of the robust weights, 1 for an inlier
  double residual_sq_sum = 0.0;  // weighted so [m^2]
  double curvature_sum = 0.0;    // sum for the robust cost
  double information_sum = 0.0;  // sum for the cost with constant weights
  int num_matched = 0;
};

[[nodiscard]] DirectionSplit SplitDirections(const MatchSums& sums);

// One row of the problem at the solution.
struct ScoredRow {
  std::int32_t part = 0;  // the map's
  float weight = 0.f;     // [1/m^2]
  Vector6f jacobian;
  Vector6f score;  // the row's gradient
};

// Holds the scores of a match at its solution.
class MatchScores {
 public:
  void Reset(std::size_t num_parts, const Pose& T_imu_lidar);
  void Add(const Eigen::Vector3f& point_imu, const ScoredRow& row);

  // Returns the covariance of the whole gradient.
  [[nodiscard]] Matrix6 Covariance() const { return by_part_.Covariance(); }
  // Fills the result's scores by beam direction, and the covariances of its blind directions: the
  // noise of the normals answers a shift along one by a score of each part, and the pose by the
  // shift across it that these scores make.
  void Complete(double curvature_ratio, MatchResult& result);

 private:
  PoseScores by_part_;
  PoseScores along_;  // by part, of a shift along a blind direction
  BeamScores by_beam_;
  std::vector<ScoredRow> rows_;
};

struct SolvedSums {
  Matrix6 inverse;    // ObservableInverse() of the information
  Vector6 last_step;  // Gauss-Newton's, left at the solution, within the observable directions
};

// Fills the result's information, covariances, eigenvalues, degenerate directions and residual, and
// turns kConverged into kDegenerate where a direction is degenerate. `score_cov` is the covariance
// of the whole gradient (ClusterScores::Covariance).
[[nodiscard]] SolvedSums Summarise(const MatchSums& sums, const Matrix6& score_cov,
                                   MatchResult& result);

// Moves the result's pose by the last step that Summarise() returned, unless it is longer than 5 mm
// or mrad: iterations stop at a step of finite length, and this one costs nothing.
void TakeLastStep(const Vector6& step, MatchResult& result);

// The end of a match whose parts are told by `scores`: the result, at whose pose the sums were
// taken, gets the number of terms and, unless those are too few, all that Summarise() gives and the
// last step.
void FinishMatch(const MatchSums& sums, MatchScores& scores, bool has_enough, MatchResult& result);

// Is the pose farther from its guess than the covariances of both allow?
[[nodiscard]] bool ContradictsGuess(const MatchResult& result, const MatchInput& input);

// Takes the mean over matched points of (points that this scan adds to a voxel) / (points in it
// after), which is MatchResult::new_content_share.
class NewContentMean {
 public:
  // A matched point in a voxel of so many points, to which the scan adds so many ...
  void Add(double num_in_voxel, double num_added) {
    sum_ += num_added / (num_in_voxel + num_added);
    ++num_;
  }
  // ... or in one that takes no more.
  void AddFrozen() { ++num_; }
  void operator+=(const NewContentMean& other) {
    sum_ += other.sum_;
    num_ += other.num_;
  }
  // One where no point was matched: all is new.
  [[nodiscard]] double share() const { return num_ == 0 ? 1.0 : sum_ / static_cast<double>(num_); }

 private:
  double sum_ = 0.0;
  std::size_t num_ = 0;
};

}  // namespace lio
