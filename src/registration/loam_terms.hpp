// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Keeps the correspondences of one round of LOAM and what is done with them: linearised for a step
// and for what is reported, or solved by Ceres. The target frame is the one that T_target_imu leads
// to.
#pragma once

#include <span>
#include <vector>

#include "lio/registration/loam_options.hpp"
#include "lio/registration/match_summary.hpp"
#include "registration/loam_solver.hpp"

namespace lio {

// Holds an edge point and its line.
struct EdgeTerm {
  std::int32_t point = 0;
  std::int32_t part = 0;  // part of the target; terms of one part share its errors
  Vector3 on_line;
  Vector3 direction;           // unit
  double direction_var = 0.0;  // variance of each of its two components across [rad^2]
  double weight = 0.0;         // at the last linearisation, 1 / m^2
};

// Holds a surface point and its plane.
struct PlaneTerm {
  std::int32_t point = 0;
  std::int32_t part = 0;
  Vector3 on_plane;
  Matrix3 axes;                // columns: normal, tangents
  Eigen::Vector2d normal_var;  // variance of the normal's tilt toward either tangent [rad^2]
  double weight = 0.0;
};

class LoamTerms {
 public:
  explicit LoamTerms(const LoamOptions& options) : options_(options) {}

  void Clear();
  void Add(const EdgeTerm& term) { edges_.push_back(term); }
  void Add(const PlaneTerm& term) { planes_.push_back(term); }
  std::size_t size() const { return edges_.size() + planes_.size(); }
  const std::vector<EdgeTerm>& edges() const { return edges_; }
  const std::vector<PlaneTerm>& planes() const { return planes_; }

  // Returns the pose after Ceres, from `T_target_imu`. `sweep_ratios` are those of each point, as
  // in loam_factors.hpp; empty: all 1.
  Pose Solve(std::span<const Eigen::Vector3f> points_imu, std::span<const float> sweep_ratios,
             const Pose& T_target_imu);
  // Sets the terms' weights. Information is in units of 1 / surface variance. Adds the terms'
  // scores where a place for them is given.
  MatchSums Linearize(std::span<const Eigen::Vector3f> points_imu, const Pose& T_target_imu,
                      MatchScores* scores);
  // Returns the cost with the weights of the last Linearize.
  double FixedCorrespondenceCost(std::span<const Eigen::Vector3f> points_imu,
                                 const Pose& T_target_imu) const;

 private:
  LoamOptions options_;
  std::vector<EdgeTerm> edges_;
  std::vector<PlaneTerm> planes_;
  LoamSolver solver_;
};

}  // namespace lio
