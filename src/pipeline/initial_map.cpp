// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/pipeline/initial_map.hpp"

#include <fmt/format.h>

#include "lio/relocalization/parameters.hpp"

namespace lio {
namespace {

constexpr MapSearchParameters kSearch = kRelocalization.map_search;
constexpr MapSearchScale kScale = MapSearchParameters::kFromAbove;
constexpr float kMaxExtent_m = kScale.cell_m * kSearch.max_cells_per_side - 2.f * kScale.margin_m;

}  // namespace

std::string WhyUnusable(std::span<const Eigen::Vector3f> points) {
  if (points.empty()) return "has no points";
  Eigen::Vector3f low = points.front();
  Eigen::Vector3f high = points.front();
  for (const Eigen::Vector3f& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const float farthest_m = low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff();
  if (!(farthest_m < kSearch.max_coordinate_m)) {
    return fmt::format(
        "has points {:.0f} km from its origin, where floats are too coarse: shift it nearer",
        1e-3f * farthest_m);
  }
  const float extent_m = (high - low).head<2>().maxCoeff();
  if (!(extent_m < kMaxExtent_m)) {
    return fmt::format(
        "is {:.1f} km wide, and at most {:.1f} km can be searched: cut out the part "
        "where you are",
        1e-3f * extent_m, 1e-3f * kMaxExtent_m);
  }
  return {};
}

}  // namespace lio
