// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/structure_pyramid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lio {
namespace {

constexpr MapSearchParameters kSearch = kRelocalization.map_search;

// Returns the box around the points, or around the origin without any, with a margin.
Eigen::AlignedBox3f BoxAround(std::span<const Eigen::Vector3f> points,
                              const Eigen::Vector3f& margin_m) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& point : points) box.extend(point);
  if (box.isEmpty()) box.extend(Eigen::Vector3f::Zero());
  return {box.min() - margin_m, box.max() + margin_m};
}

Eigen::Vector3f NumCells(const Eigen::AlignedBox3f& box, float cell_m) {
  return (box.sizes() / cell_m).array().ceil() + 1.f;
}

}  // namespace

StructurePyramid StructurePyramid::FromAbove(std::span<const Eigen::Vector2f> things) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(things.size());
  for (const Eigen::Vector2f& thing : things) points.emplace_back(thing.x(), thing.y(), 0.f);
  return {points, MapSearchParameters::kFromAbove, true};
}

StructurePyramid StructurePyramid::InBuilding(std::span<const Eigen::Vector3f> points) {
  return {points, MapSearchParameters::kInBuilding, false};
}

bool StructurePyramid::IsOfBuilding(std::span<const Eigen::Vector3f> points) {
  constexpr MapSearchScale kScale = MapSearchParameters::kInBuilding;
  const auto box = BoxAround(points, Eigen::Vector3f::Constant(kScale.margin_m));
  return NumCells(box, kScale.cell_m).cast<double>().prod() < kSearch.max_cells_of_building;
}

StructurePyramid::StructurePyramid(std::span<const Eigen::Vector3f> points,
                                   const MapSearchScale& scale, bool is_flat)
    : scale_(scale), is_flat_(is_flat) {
  const auto box =
      BoxAround(points, {scale.margin_m, scale.margin_m, is_flat ? 0.f : scale.margin_m});
  const Eigen::Vector3f num_cells = NumCells(box, scale.cell_m);
  if (!(num_cells.maxCoeff() <= static_cast<float>(kSearch.max_cells_per_side + 1))) {
    throw std::invalid_argument("StructurePyramid: the points spread too far");
  }
  corner_m_ = box.min();
  if (is_flat) corner_m_.z() = -0.5f * scale.cell_m;
  size_ = num_cells.cast<int>();
  BuildLevels(MarkPoints(points));
}

StructurePyramid::Grid StructurePyramid::MarkPoints(std::span<const Eigen::Vector3f> points) const {
  Grid marked(static_cast<std::size_t>(size_.x()) * size_.y() * size_.z(), 0);
  for (const Eigen::Vector3f& point : points) {
    MarkAround(point, marked);
    const Eigen::Vector3i at = CellOf(point);
    marked[IndexOf(at.x(), at.y(), at.z(), size_)] = kThing;
  }
  return marked;
}

void StructurePyramid::MarkAround(const Eigen::Vector3f& point, Grid& marked) const {
  Eigen::Vector3f reach_m = Eigen::Vector3f::Constant(scale_.reach_cells * scale_.cell_m);
  if (is_flat_) reach_m.z() = 0.f;
  const Eigen::Vector3i low = CellOf(point - reach_m).cwiseMax(0);
  const Eigen::Vector3i high = CellOf(point + reach_m).cwiseMin((size_.array() - 1).matrix());
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        std::uint8_t& cell = marked[IndexOf(x, y, z, size_)];
        cell = std::max(cell, kNear);
      }
    }
  }
}

StructurePyramid::Grid StructurePyramid::Halved(const Grid& grid, const Eigen::Vector3i& size,
                                                const Eigen::Vector3i& half) {
  Grid halved(static_cast<std::size_t>(half.x()) * half.y() * half.z(), 0);
  std::size_t i = 0;
  for (int z = 0; z < size.z(); ++z) {
    for (int y = 0; y < size.y(); ++y) {
      for (int x = 0; x < size.x(); ++x) {
        if (grid[i++] != 0) halved[IndexOf(x / 2, y / 2, z / 2, half)] = 1;
      }
    }
  }
  return halved;
}

StructurePyramid::Grid StructurePyramid::Widened(const Grid& grid, Eigen::Vector3i& size, int axis,
                                                 int tolerance) {
  Eigen::Vector3i wide = size;
  wide[axis] += tolerance;
  const std::size_t stride = IndexOf(axis == 0, axis == 1, axis == 2, wide);
  Grid result(static_cast<std::size_t>(wide.x()) * wide.y() * wide.z(), 0);
  std::size_t i = 0;
  for (int z = 0; z < size.z(); ++z) {
    for (int y = 0; y < size.y(); ++y) {
      for (int x = 0; x < size.x(); ++x) {
        if (grid[i++] == 0) continue;
        std::size_t at = IndexOf(x, y, z, wide);
        for (int by = 0; by <= tolerance; ++by, at += stride) result[at] = 1;
      }
    }
  }
  size = wide;
  return result;
}

void StructurePyramid::BuildLevels(Grid marked) {
  constexpr int kLog2Cells = kSearch.log2_cells_per_block;
  Eigen::Vector3i marked_size = size_;
  for (int level = 0; level < scale_.num_levels; ++level) {
    Level& added = levels_.emplace_back();
    added.shift = std::max(0, level - kLog2Cells);
    if (added.shift > 0) {
      const Eigen::Vector3i half = (marked_size.array() + 1) / 2;
      marked = Halved(marked, marked_size, half);
      marked_size = half;
    }
    // A block begins anywhere in a cell, so that it may touch one more than it is wide.
    added.tolerance = added.shift > 0 ? 1 << kLog2Cells : (1 << level) - 1;
    added.size = marked_size;
    added.grid = marked;
    if (added.tolerance == 0) continue;
    for (int axis = 0; axis < (is_flat_ ? 2 : 3); ++axis) {
      added.grid = Widened(added.grid, added.size, axis, added.tolerance);
    }
  }
}

Eigen::Vector3i StructurePyramid::CellOf(const Eigen::Vector3f& point) const {
  return ((point - corner_m_) / scale_.cell_m).array().floor().cast<int>();
}

Eigen::Vector3f StructurePyramid::CentreOf(const Eigen::Vector3i& cell) const {
  return corner_m_ + scale_.cell_m * (cell.cast<float>().array() + 0.5f).matrix();
}

}  // namespace lio
