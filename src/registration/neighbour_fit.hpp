// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Fits a line or plane to a few neighbouring map points; none where they are rank-deficient or do
// not fit. Positions are relative to the query point.
#pragma once

#include <optional>

#include "lio/map/point_map.hpp"
#include "lio/registration/loam_options.hpp"

namespace lio {

struct LineFit {
  Vector3 centre;
  Vector3 direction;           // unit
  double direction_var = 0.0;  // variance of each of its two components across [rad^2]
};

struct PlaneFit {
  Vector3 centre;
  Vector3 normal;              // unit
  Matrix3 axes;                // columns: normal and the two tangents
  Eigen::Vector2d normal_var;  // variance of the normal's tilt toward either tangent [rad^2]
};

[[nodiscard]] std::optional<LineFit> FitLine(const PointMap::Neighbours& neighbours,
                                             const LoamOptions& options);
[[nodiscard]] std::optional<PlaneFit> FitPlane(const PointMap::Neighbours& neighbours,
                                               const LoamOptions& options);

}  // namespace lio
