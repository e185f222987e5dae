// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Estimates the turn rate within a sweep: it solves the terms of a match at its solution once more
// with the rate free. A scan that was deskewed by a turn rate off by e [rad/s] has each point
// rotated by t e, with t the point's time after the middle of the sweep: a term's row gains t (p x
// n), beside its derivative by the pose, [n; p x n]. The covariance is the clustered sandwich
// (cluster_scores.hpp), as for the pose. docs/experiments/intra_sweep_rate.md has figures.
#pragma once

#include "lio/base/rotation.hpp"
#include "lio/registration/cluster_scores.hpp"
#include "lio/registration/scan_matcher.hpp"

namespace lio {

class IntraSweepRateEstimator {
 public:
  // Forgets all terms. `num_parts`: see ClusterScores.
  void Reset(std::size_t num_parts);
  // Adds a term: the part of the map that it is matched to, its derivative by the pose (right
  // increment, imu axes), its residual [m], its weight [1/m^2], its point's time after the middle
  // of the sweep [s].
  void Add(std::int32_t part, const PoseScores::Score& row, float residual_m, float weight,
           float from_mid_sweep_s);
  // The correction to add to the turn rate that the scan was deskewed by. `curvature_ratio` is that
  // of MatchSums.
  [[nodiscard]] TurnRate Solve(double curvature_ratio) const;

 private:
  static constexpr int kDims = 9;  // pose, turn rate

  Eigen::Matrix<double, kDims, kDims> information_ = Eigen::Matrix<double, kDims, kDims>::Zero();
  Eigen::Matrix<double, kDims, 1> gradient_ = Eigen::Matrix<double, kDims, 1>::Zero();
  ClusterScores<kDims> scores_;
};

}  // namespace lio
