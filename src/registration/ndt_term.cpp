// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/ndt_term.hpp"

#include <algorithm>

#include "lio/registration/registration_parameters.hpp"

namespace lio {
namespace {

NdtTerm TermOfPlane(const SurfacePatch& patch, const Eigen::Vector3f& from_mean, float num_here,
                    float radius_var) {
  const float a1 = patch.tangent1_per_std.dot(from_mean);
  const float a2 = patch.tangent2_per_std.dot(from_mean);
  constexpr float kMaxLeverSq = NdtParameters::kMaxLeverSq;
  const float lever = 1.f + std::min(a1 * a1, kMaxLeverSq) + std::min(a2 * a2, kMaxLeverSq);
  const float variance =
      patch.thickness_var * (1.f + num_here / patch.num_points * lever) + radius_var;
  NdtTerm term;
  NdtRow& row = term.rows[0];
  row.direction = patch.normal;
  row.distance = patch.normal.dot(from_mean);
  term.distance_sq = row.distance * row.distance / variance;
  term.kernel = RobustKernel(term.distance_sq);
  row.weight = term.kernel.weight() / variance;
  return term;
}

// A part of a wall tells nothing of a motion along it: the cell's side and the rings decide where
// its points end.
Eigen::Vector3f SurePartOf(const Eigen::Vector3f& direction, const SurfacePatch& patch) {
  const Eigen::Vector3f& normal = patch.wall_normal();
  return normal.isZero(0.f) ? direction : Eigen::Vector3f(direction.dot(normal) * normal);
}

NdtTerm TermOfVertical(const SurfacePatch& patch, const Eigen::Vector3f& from_mean, float num_here,
                       float radius_var) {
  const float shared = 1.f + num_here / patch.num_points;  // the mean's own error
  const float across_std = 1.f / patch.tangent1_per_std.norm();
  NdtTerm term;
  term.num_rows = 2;
  term.rows[0].direction = patch.normal;
  term.rows[1].direction = across_std * patch.tangent1_per_std;
  const std::array<float, 2> variance{patch.thickness_var * shared + radius_var,
                                      across_std * across_std * shared + radius_var};
  for (std::size_t i = 0; i < 2; ++i) {
    NdtRow& row = term.rows[i];
    row.distance = row.direction.dot(from_mean);
    term.distance_sq += row.distance * row.distance / variance[i];
  }
  term.kernel = RobustKernel(term.distance_sq);
  constexpr double kShared_m = NdtParameters::kSharedInWeightsStd_m;
  constexpr auto kSharedVar_m2 = static_cast<float>(kShared_m * kShared_m);
  for (std::size_t i = 0; i < 2; ++i) {
    term.rows[i].weight = term.kernel.weight() / (variance[i] + num_here * kSharedVar_m2);
    term.rows[i].sure_weight = term.kernel.weight() / variance[i];
    term.rows[i].sure_direction = SurePartOf(term.rows[i].direction, patch);
  }
  return term;
}

}  // namespace

NdtTerm MakeNdtTerm(const SurfacePatch& patch, const Eigen::Vector3f& from_mean, float num_here,
                    float radius_var) {
  return patch.kind == SurfacePatch::Kind::kPlane
             ? TermOfPlane(patch, from_mean, num_here, radius_var)
             : TermOfVertical(patch, from_mean, num_here, radius_var);
}

}  // namespace lio
