// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/registration/place_width.hpp"

#include <array>
#include <cmath>
#include <set>

#include "lio/registration/registration_parameters.hpp"

namespace lio {
namespace {

using Parameters = PlaceWidthParameters;

constexpr float kMaxRange_m = 1e6f;  // cells beyond have numbers that no integer holds

double NumCells(std::span<const Eigen::Vector3f> points, double edge_m) {
  const auto per_metre = static_cast<float>(1.0 / edge_m);
  std::set<std::array<int, 3>> cells;
  for (const Eigen::Vector3f& point : points) {
    if (!point.allFinite() || point.cwiseAbs().maxCoeff() > kMaxRange_m) continue;
    const Eigen::Vector3i cell = (per_metre * point).array().floor().cast<int>();
    cells.insert({cell.x(), cell.y(), cell.z()});
    if (cells.size() >= Parameters::kMaxCounted) break;
  }
  return static_cast<double>(cells.size());
}

}  // namespace

void PlaceWidth::Add(std::span<const Eigen::Vector3f> points_imu, double edge_m) {
  if (points_imu.size() < Parameters::kMaxCounted) return;
  const double num_cells = NumCells(points_imu, edge_m);
  mean_cells_ =
      mean_cells_ ? *mean_cells_ + Parameters::kRate * (num_cells - *mean_cells_) : num_cells;
  if (*mean_cells_ < Parameters::kNarrowBelow) is_narrow_ = true;
  if (*mean_cells_ > Parameters::kWideAbove) is_narrow_ = false;
}

}  // namespace lio
