// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "registration/neighbour_fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "lio/registration/registration_parameters.hpp"

namespace lio {
namespace {

struct Moments {
  Vector3 mean = Vector3::Zero();
  Vector3 variance;  // ascending
  Matrix3 axes;      // columns
  double count = 0.0;
  double points_each = 0.0;  // each neighbour is the mean of so many
};

Moments MomentsOf(const PointMap::Neighbours& neighbours) {
  Moments moments;
  moments.count = neighbours.count;
  const auto count = static_cast<std::size_t>(neighbours.count);
  for (std::size_t i = 0; i < count; ++i) {
    moments.mean += neighbours.list[i].from_query.cast<double>();
    moments.points_each += neighbours.list[i].num_points / moments.count;
  }
  moments.mean /= moments.count;
  Matrix3 cov = Matrix3::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3 d = neighbours.list[i].from_query.cast<double>() - moments.mean;
    cov += d * d.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Matrix3> eigen;
  eigen.computeDirect(cov / moments.count);
  moments.variance = eigen.eigenvalues().cwiseMax(0.0);
  moments.axes = eigen.eigenvectors();
  return moments;
}

// Returns the variance that range noise alone leaves in a mean.
double NoiseVar(const Moments& moments, const LoamOptions& options) {
  return options.surface_std_m * options.surface_std_m / moments.points_each;
}

}  // namespace

std::optional<LineFit> FitLine(const PointMap::Neighbours& neighbours, const LoamOptions& options) {
  if (neighbours.count < options.num_neighbours) return std::nullopt;
  const Moments moments = MomentsOf(neighbours);
  if (moments.variance[2] < options.min_line_ratio * moments.variance[1]) return std::nullopt;
  const double min_length = LoamParameters::kMinWidthPerLeaf * options.edge_leaf_m;
  if (moments.variance[2] < min_length * min_length) return std::nullopt;
  const double across_var = std::max(moments.variance[1], NoiseVar(moments, options));
  return LineFit{moments.mean, moments.axes.col(2),
                 across_var / (moments.count * moments.variance[2])};
}

std::optional<PlaneFit> FitPlane(const PointMap::Neighbours& neighbours,
                                 const LoamOptions& options) {
  if (neighbours.count < options.num_neighbours) return std::nullopt;
  const Moments moments = MomentsOf(neighbours);
  const double min_width = LoamParameters::kMinWidthPerLeaf * options.surface_leaf_m;
  if (moments.variance[1] < min_width * min_width) return std::nullopt;
  const double thickness_var = std::max(moments.variance[0], NoiseVar(moments, options));
  PlaneFit plane{moments.mean,
                 moments.axes.col(0),
                 moments.axes,
                 {thickness_var / (moments.count * moments.variance[1]),
                  thickness_var / (moments.count * moments.variance[2])}};
  constexpr double kMaxStd_rad = LoamParameters::kMaxNormalStd_rad;
  if (plane.normal_var[0] > kMaxStd_rad * kMaxStd_rad) return std::nullopt;
  for (std::size_t i = 0; i < static_cast<std::size_t>(neighbours.count); ++i) {
    const Vector3 d = neighbours.list[i].from_query.cast<double>() - moments.mean;
    if (std::abs(plane.normal.dot(d)) > options.max_plane_error_m) return std::nullopt;
  }
  return plane;
}

}  // namespace lio
