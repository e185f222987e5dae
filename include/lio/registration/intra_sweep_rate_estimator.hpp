// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// How the body turned within a sweep: the terms of a match at its solution, solved once more with
// the turn rate free. A scan that was deskewed by a turn rate off by e [rad/s] has each point
// turned by t e, with t the point's time after the sweep's middle: a term's row gains t (p x n),
// beside its derivative by the pose, [n; p x n]. Covariance: the clustered sandwich, as of the
// pose.
#pragma once

#include "lio/base/rotation.hpp"
#include "lio/registration/cluster_scores.hpp"
#include "lio/registration/scan_matcher.hpp"

namespace lio {

class IntraSweepRateEstimator {
 public:
  // `num_parts`: as of ClusterScores.
  void Reset(std::size_t num_parts);
  // One term: the part of the map it is held against, its derivative by the pose (right increment,
  // imu axes), its residual [m], its weight [1/m^2], its point's time after the middle [s].
  void Add(std::int32_t part, const PoseScores::Score& row, float residual_m, float weight,
           float from_mid_sweep_s);
  // What to add to the turn rate that the scan was deskewed by. `curvature_ratio`: MatchSums's.
  TurnRate Solve(double curvature_ratio) const;

 private:
  static constexpr int kDims = 9;  // pose, turn rate

  Eigen::Matrix<double, kDims, kDims> information_ = Eigen::Matrix<double, kDims, kDims>::Zero();
  Eigen::Matrix<double, kDims, 1> gradient_ = Eigen::Matrix<double, kDims, 1>::Zero();
  ClusterScores<kDims> scores_;
};

}  // namespace lio
