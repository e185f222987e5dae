// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Solves one Ceres problem over one pose: edge and plane terms with Huber's loss. Terms lie next to
// each other rather than each in an allocation of its own.
#pragma once

#include <deque>
#include <vector>

#include "lio/registration/loam_options.hpp"
#include "registration/loam_factors.hpp"

namespace lio {

struct LoamSolverOptions {
  double huber_m = LoamOptions{}.huber_m;
  double edge_weight = 1.0;  // weight of a squared edge residual against a plane's; A-LOAM's
  int max_iterations = LoamOptions{}.max_iterations;
};

class LoamSolver {
 public:
  void Clear();
  // Adds the line through a and b, which are at least LoamParameters::kMinLineLength_m apart. `s`
  // is the sweep ratio; below 1 the terms are automatic ones.
  void AddEdge(const Vector3& point, const Vector3& a, const Vector3& b, double s);
  void AddPlane(const Vector3& point, const Vector3& normal, double offset, double s);

  // Solves from `start`; returns the pose itself when Ceres fails.
  Pose Solve(const Pose& start, const LoamSolverOptions& options);

 private:
  std::deque<EdgeFactor> edges_;  // cost functions cannot be moved
  std::deque<PlaneFactor> planes_;
  std::vector<CostPtr> partial_edges_;  // for a sweep ratio below 1
  std::vector<CostPtr> partial_planes_;
};

}  // namespace lio
