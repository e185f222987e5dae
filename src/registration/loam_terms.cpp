// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/loam_terms.hpp"

#include <cmath>

namespace lio {
namespace {

double HuberWeight(double residual, double huber) {
  return residual <= huber ? 1.0 : huber / residual;
}

// The robust cost is curved only where the residual is not yet in its linear part.
void Count(double kernel, double weight, double residual_sq, MatchSums& sums) {
  sums.weight_sum += kernel;
  sums.residual_sq_sum += kernel * residual_sq;
  sums.information_sum += weight;
  if (kernel == 1.0) sums.curvature_sum += weight;
  ++sums.num_matched;
}

}  // namespace

void LoamTerms::Clear() {
  edges_.clear();
  planes_.clear();
}

Pose LoamTerms::Solve(std::span<const Eigen::Vector3f> points_imu,
                      std::span<const float> sweep_ratios, const Pose& T_target_imu) {
  solver_.Clear();
  const auto point = [&](std::int32_t i) -> Vector3 {
    return points_imu[static_cast<std::size_t>(i)].cast<double>();
  };
  const auto ratio = [&](std::int32_t i) {
    return sweep_ratios.empty() ? 1.0 : double{sweep_ratios[static_cast<std::size_t>(i)]};
  };
  for (const EdgeTerm& term : edges_) {
    solver_.AddEdge(point(term.point), term.on_line, term.on_line + term.direction,
                    ratio(term.point));
  }
  for (const PlaneTerm& term : planes_) {
    const Vector3 normal = term.axes.col(0);
    solver_.AddPlane(point(term.point), normal, -normal.dot(term.on_plane), ratio(term.point));
  }
  LoamSolverOptions options;
  options.huber_m = options_.huber_m;
  options.max_iterations = options_.max_iterations;
  const double std_ratio = options_.surface_std_m / options_.edge_std_m;
  options.edge_weight = std_ratio * std_ratio;
  return solver_.Solve(T_target_imu, options);
}

MatchSums LoamTerms::Linearize(std::span<const Eigen::Vector3f> points_imu,
                               const Pose& T_target_imu, MatchScores* scores) {
  MatchSums sums;
  const Matrix3 to_imu = T_target_imu.rotation.conjugate().toRotationMatrix();
  const auto row = [&](const Eigen::Vector3f& point, const Vector3& direction) {
    return JacobianRow(point, (to_imu * direction).cast<float>());
  };
  const auto add_row = [&](const auto& term, const Vector6f& jacobian, double residual_m) {
    const auto weight = static_cast<float>(term.weight);
    const Vector6f score = static_cast<float>(term.weight * residual_m) * jacobian;
    sums.information.Add(jacobian, weight);
    sums.gradient += score.cast<double>();
    if (scores == nullptr) return;
    scores->Add(points_imu[static_cast<std::size_t>(term.point)],
                {term.part, weight, jacobian, score});
  };
  for (PlaneTerm& term : planes_) {
    const Eigen::Vector3f& point = points_imu[static_cast<std::size_t>(term.point)];
    const double residual =
        term.axes.col(0).dot(T_target_imu * point.cast<double>() - term.on_plane);
    const double kernel = HuberWeight(std::abs(residual), options_.huber_m);
    term.weight = kernel / (options_.surface_std_m * options_.surface_std_m);
    add_row(term, row(point, term.axes.col(0)), residual);
    for (int j = 0; j < 2; ++j) {
      sums.noise_information.Add(row(point, term.axes.col(j + 1)),
                                 static_cast<float>(term.weight * term.normal_var[j]));
    }
    Count(kernel, term.weight, residual * residual, sums);
  }
  for (EdgeTerm& term : edges_) {
    const Eigen::Vector3f& point = points_imu[static_cast<std::size_t>(term.point)];
    const Vector3 offset = T_target_imu * point.cast<double>() - term.on_line;
    const Vector3 across = offset - term.direction.dot(offset) * term.direction;
    const double kernel = HuberWeight(across.norm(), options_.huber_m);
    term.weight = kernel / (options_.edge_std_m * options_.edge_std_m);
    const Vector3 side = term.direction.unitOrthogonal();
    const Vector3 other_side = term.direction.cross(side);
    for (const Vector3& axis : {side, other_side}) {
      add_row(term, row(point, axis), axis.dot(across));
    }
    sums.noise_information.Add(row(point, term.direction),
                               static_cast<float>(2.0 * term.weight * term.direction_var));
    Count(kernel, term.weight, 0.5 * across.squaredNorm(), sums);
  }
  return sums;
}

double LoamTerms::FixedCorrespondenceCost(std::span<const Eigen::Vector3f> points_imu,
                                          const Pose& T_target_imu) const {
  double cost = 0.0;
  const auto moved = [&](std::int32_t i) {
    return T_target_imu * points_imu[static_cast<std::size_t>(i)].cast<double>();
  };
  for (const PlaneTerm& term : planes_) {
    const double residual = term.axes.col(0).dot(moved(term.point) - term.on_plane);
    cost += 0.5 * term.weight * residual * residual;
  }
  for (const EdgeTerm& term : edges_) {
    const Vector3 residual = term.direction.cross(moved(term.point) - term.on_line);
    cost += 0.5 * term.weight * residual.squaredNorm();
  }
  return cost;
}

}  // namespace lio
