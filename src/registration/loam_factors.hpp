// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// LOAM's terms as Ceres cost functions over one pose block (pose_manifold.hpp), residuals in
// metres. T maps the scan's points into the target's frame; with sweep ratio s < 1 a point is moved
// by only that part of it, Slerp(I, q, s) p + s t: the pose is then the motion during a sweep, s
// the point's share of the sweep's time.
//   edge          r = (p - a) x (p - b) / |a - b|  (3)   distance from the line through a and b
//   plane         r = n . (p - a)  (1)                   by three of its points, or n . p + d
//   point         r = p - a  (3)
// Three components for the edge, not their norm: on the line the norm has no derivative. A line
// shorter than 1 cm, and three points that span no plane, are refused with a null pointer.
// Matches against the last scan use them: the analytic ones where s = 1; the automatic ones serve
// s < 1 and check the analytic ones.
// Source: Zhang and Singh, "LOAM", RSS 2014, eqs. (2) and (3).
#pragma once

#include <ceres/sized_cost_function.h>

#include <memory>

#include "lio/base/pose.hpp"
#include "lio/registration/registration_parameters.hpp"

namespace lio {

using CostPtr = std::unique_ptr<ceres::CostFunction>;

[[nodiscard]] CostPtr MakeAutoEdge(const Vector3& point, const Vector3& a, const Vector3& b,
                                   double s = 1.0);
[[nodiscard]] CostPtr MakeAutoPlaneByPoints(const Vector3& point, const Vector3& a,
                                            const Vector3& b, const Vector3& c, double s = 1.0);
// The plane n . p + offset = 0, |n| = 1.
[[nodiscard]] CostPtr MakeAutoPlane(const Vector3& point, const Vector3& normal, double offset,
                                    double s = 1.0);
[[nodiscard]] CostPtr MakeAutoPoint(const Vector3& point, const Vector3& target, double s = 1.0);

// |b - a| must be at least LoamParameters::kMinLineLength_m.
class EdgeFactor final : public ceres::SizedCostFunction<3, 7> {
 public:
  EdgeFactor(const Vector3& point, const Vector3& a, const Vector3& b)
      : point_(point), direction_((b - a).normalized()), moment_(a.cross(direction_)) {}
  bool Evaluate(double const* const* blocks, double* residual, double** jacobians) const override;

 private:
  // (p - a) x (p - b) / |a - b| = u x p + m, u the line's direction from a to b: linear in p.
  Vector3 point_, direction_, moment_;
};

// |normal| = 1.
class PlaneFactor final : public ceres::SizedCostFunction<1, 7> {
 public:
  PlaneFactor(const Vector3& point, const Vector3& normal, double offset)
      : point_(point), normal_(normal), offset_(offset) {}
  bool Evaluate(double const* const* blocks, double* residual, double** jacobians) const override;

 private:
  Vector3 point_, normal_;
  double offset_;
};

}  // namespace lio
