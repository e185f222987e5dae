// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/loam_factors.hpp"

#include <ceres/autodiff_cost_function.h>

namespace lio {
namespace {

// Moves the point by the part s of the pose.
template <class T>
Eigen::Matrix<T, 3, 1> Move(const T* block, const Vector3& point, double s) {
  const Eigen::Map<const Eigen::Quaternion<T>> rotation(block);
  const Eigen::Map<const Eigen::Matrix<T, 3, 1>> translation(block + 4);
  if (s == 1.0) return rotation * point.cast<T>() + translation;
  const Eigen::Quaternion<T> part = Eigen::Quaternion<T>::Identity().slerp(T(s), rotation);
  return part * point.cast<T>() + T(s) * translation;
}

struct AutoEdge {
  Vector3 point, a, b;
  double s;
  template <class T>
  bool operator()(const T* block, T* residual) const {
    const Eigen::Matrix<T, 3, 1> p = Move(block, point, s);
    const Eigen::Matrix<T, 3, 1> from_a = p - a.cast<T>();
    const Eigen::Matrix<T, 3, 1> from_b = p - b.cast<T>();
    Eigen::Map<Eigen::Matrix<T, 3, 1>> r(residual);
    r = from_a.cross(from_b) / T((a - b).norm());
    return true;
  }
};

struct AutoPlane {
  Vector3 point, normal;
  double offset;
  double s;
  template <class T>
  bool operator()(const T* block, T* residual) const {
    residual[0] = normal.cast<T>().dot(Move(block, point, s)) + T(offset);
    return true;
  }
};

struct AutoPoint {
  Vector3 point, target;
  double s;
  template <class T>
  bool operator()(const T* block, T* residual) const {
    Eigen::Map<Eigen::Matrix<T, 3, 1>> r(residual);
    r = Move(block, point, s) - target.cast<T>();
    return true;
  }
};

using PointJacobian = Eigen::Matrix<double, 3, 7>;

// Returns the moved point and its derivative by the seven numbers of the block:
//   q p = p + 2 w v x p + 2 v x (v x p).
Vector3 Move(const double* block, const Vector3& p, PointJacobian* jacobian) {
  const Eigen::Map<const Quaternion> rotation(block);
  const Eigen::Map<const Vector3> translation(block + 4);
  if (jacobian != nullptr) {
    const Vector3 v = rotation.vec();
    jacobian->leftCols<3>() = 2.0 * (v.dot(p) * Matrix3::Identity() + v * p.transpose() -
                                     2.0 * p * v.transpose() - rotation.w() * Hat(p));
    jacobian->col(3) = 2.0 * v.cross(p);
    jacobian->rightCols<3>().setIdentity();
  }
  return rotation * p + translation;
}

constexpr double kMinLineLength_m = LoamParameters::kMinLineLength_m;

}  // namespace

bool EdgeFactor::Evaluate(double const* const* blocks, double* residual, double** jacobians) const {
  const bool wants_jacobian = jacobians != nullptr && jacobians[0] != nullptr;
  PointJacobian by_block;
  const Vector3 p = Move(blocks[0], point_, wants_jacobian ? &by_block : nullptr);
  Eigen::Map<Vector3> r(residual);
  r = direction_.cross(p) + moment_;
  if (wants_jacobian) {
    Eigen::Map<Eigen::Matrix<double, 3, 7, Eigen::RowMajor>> jacobian(jacobians[0]);
    jacobian.noalias() = Hat(direction_) * by_block;
  }
  return true;
}

bool PlaneFactor::Evaluate(double const* const* blocks, double* residual,
                           double** jacobians) const {
  const bool wants_jacobian = jacobians != nullptr && jacobians[0] != nullptr;
  PointJacobian by_block;
  const Vector3 p = Move(blocks[0], point_, wants_jacobian ? &by_block : nullptr);
  residual[0] = normal_.dot(p) + offset_;
  if (wants_jacobian) {
    Eigen::Map<Eigen::Matrix<double, 1, 7>> jacobian(jacobians[0]);
    jacobian.noalias() = normal_.transpose() * by_block;
  }
  return true;
}

CostPtr MakeAutoEdge(const Vector3& point, const Vector3& a, const Vector3& b, double s) {
  if ((a - b).norm() < kMinLineLength_m) return nullptr;
  return std::make_unique<ceres::AutoDiffCostFunction<AutoEdge, 3, 7>>(
      new AutoEdge{point, a, b, s});
}

CostPtr MakeAutoPlaneByPoints(const Vector3& point, const Vector3& a, const Vector3& b,
                              const Vector3& c, double s) {
  const Vector3 normal = (b - a).cross(c - a);
  // Twice the triangle's area: so narrow a triangle has no plane.
  if (normal.norm() < kMinLineLength_m * kMinLineLength_m) return nullptr;
  const Vector3 unit = normal.normalized();
  return MakeAutoPlane(point, unit, -unit.dot(a), s);
}

CostPtr MakeAutoPlane(const Vector3& point, const Vector3& normal, double offset, double s) {
  return std::make_unique<ceres::AutoDiffCostFunction<AutoPlane, 1, 7>>(
      new AutoPlane{point, normal, offset, s});
}

CostPtr MakeAutoPoint(const Vector3& point, const Vector3& target, double s) {
  return std::make_unique<ceres::AutoDiffCostFunction<AutoPoint, 3, 7>>(
      new AutoPoint{point, target, s});
}

}  // namespace lio
