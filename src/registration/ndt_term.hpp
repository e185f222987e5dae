// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Gives the term that one point adds to NDT's cost, matched to the surface patch of its cell
// (ndt_matcher.hpp has the formula).
#pragma once

#include <array>

#include "lio/map/gaussian_map.hpp"
#include "lio/registration/match_summary.hpp"

namespace lio {

struct NdtRow {
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();  // axes of the patch
  float distance = 0.f;                                 // m
  float weight = 0.f;                                   // 1 / m^2
  // A vertical structure's: without the error that its points share [1 / m^2], and without the part
  // of the direction along which nothing is sure.
  float sure_weight = 0.f;
  Eigen::Vector3f sure_direction = Eigen::Vector3f::Zero();
};

// Has one row for a plane, two for a vertical structure.
struct NdtTerm {
  std::array<NdtRow, 2> rows;
  int num_rows = 1;
  float distance_sq = 0.f;  // over its variance
  RobustKernel kernel;

  [[nodiscard]] bool IsOutlier() const { return RobustKernel::IsOutlier(distance_sq); }
};

// `num_here` counts this scan's points in the cell; `radius_var` is the correspondence radius,
// squared [m^2].
[[nodiscard]] NdtTerm MakeNdtTerm(const SurfacePatch& patch, const Eigen::Vector3f& from_mean,
                                  float num_here, float radius_var);

}  // namespace lio
