// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/loam_solver.hpp"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include "registration/pose_manifold.hpp"

namespace lio {
namespace {

ceres::Problem::Options ProblemOptions() {
  ceres::Problem::Options options;
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.disable_all_safety_checks = true;
  return options;
}

}  // namespace

void LoamSolver::Clear() {
  edges_.clear();
  planes_.clear();
  partial_edges_.clear();
  partial_planes_.clear();
}

void LoamSolver::AddEdge(const Vector3& point, const Vector3& a, const Vector3& b, double s) {
  if (s == 1.0) {
    edges_.emplace_back(point, a, b);
  } else {
    partial_edges_.push_back(MakeAutoEdge(point, a, b, s));
  }
}

void LoamSolver::AddPlane(const Vector3& point, const Vector3& normal, double offset, double s) {
  if (s == 1.0) {
    planes_.emplace_back(point, normal, offset);
  } else {
    partial_planes_.push_back(MakeAutoPlane(point, normal, offset, s));
  }
}

Pose LoamSolver::Solve(const Pose& start, const LoamSolverOptions& options) {
  ceres::HuberLoss plane_loss(options.huber_m);
  ceres::ScaledLoss edge_loss(&plane_loss, options.edge_weight, ceres::DO_NOT_TAKE_OWNERSHIP);
  PoseManifold manifold;
  PoseBlock block = ToBlock(start);
  ceres::Problem problem(ProblemOptions());
  problem.AddParameterBlock(block.data(), 7, &manifold);
  const auto add = [&](ceres::CostFunction* cost, ceres::LossFunction* loss) {
    problem.AddResidualBlock(cost, loss, block.data());
  };
  for (EdgeFactor& edge : edges_) add(&edge, &edge_loss);
  for (PlaneFactor& plane : planes_) add(&plane, &plane_loss);
  for (const CostPtr& edge : partial_edges_) add(edge.get(), &edge_loss);
  for (const CostPtr& plane : partial_planes_) add(plane.get(), &plane_loss);
  ceres::Solver::Options solver;
  // The dense solvers split their sums by the size of the processor's cache: other bits elsewhere.
  solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  solver.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  solver.max_num_iterations = options.max_iterations;
  solver.logging_type = ceres::SILENT;
  solver.num_threads = 1;  // sums in one order: the same bits always
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  return summary.IsSolutionUsable() ? ToPose(block.data()) : start;
}

}  // namespace lio
