// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/relocalization/structure_pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lio/relocalization/parameters.hpp"

namespace lio {
namespace {

using Grid = std::vector<std::uint8_t>;

std::size_t IndexOf(int x, int y, const Eigen::Vector2i& size) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x()) +
         static_cast<std::size_t>(x);
}

// Returns half as many cells along x and y; each is marked where any of its four is.
Grid Halved(const Grid& grid, const Eigen::Vector2i& size, const Eigen::Vector2i& half) {
  Grid halved(IndexOf(0, half.y(), half), 0);
  for (int y = 0; y < size.y(); ++y) {
    for (int x = 0; x < size.x(); ++x) {
      if (grid[IndexOf(x, y, size)] != 0) halved[IndexOf(x / 2, y / 2, half)] = 1;
    }
  }
  return halved;
}

// Marks the cells up to `tolerance` before each marked one, along x and y; the result begins as
// many cells before the grid.
Grid Widened(const Grid& grid, const Eigen::Vector2i& size, int tolerance) {
  const Eigen::Vector2i wide(size.x() + tolerance, size.y());
  const Eigen::Vector2i result_size(size.x() + tolerance, size.y() + tolerance);
  Grid along_x(IndexOf(0, wide.y(), wide), 0);
  for (int y = 0; y < size.y(); ++y) {
    for (int x = 0; x < size.x(); ++x) {
      if (grid[IndexOf(x, y, size)] == 0) continue;
      for (int by = 0; by <= tolerance; ++by) along_x[IndexOf(x + by, y, wide)] = 1;
    }
  }
  Grid result(IndexOf(0, result_size.y(), result_size), 0);
  for (int y = 0; y < wide.y(); ++y) {
    for (int x = 0; x < wide.x(); ++x) {
      if (along_x[IndexOf(x, y, wide)] == 0) continue;
      for (int by = 0; by <= tolerance; ++by) result[IndexOf(x, y + by, result_size)] = 1;
    }
  }
  return result;
}

}  // namespace

StructurePyramid::StructurePyramid(std::span<const Eigen::Vector2f> points) {
  Frame(points);
  BuildLevels(MarkThings(points));
}

void StructurePyramid::Frame(std::span<const Eigen::Vector2f> points) {
  Eigen::Vector2f low = Eigen::Vector2f::Zero();
  Eigen::Vector2f high = Eigen::Vector2f::Zero();
  if (!points.empty()) low = high = points.front();
  for (const Eigen::Vector2f& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const Eigen::Vector2f extent_m =
      high - low + Eigen::Vector2f::Constant(2.f * kRelocalization.map_search.margin_m);
  if (!(extent_m.maxCoeff() <
        kRelocalization.map_search.cell_m * kRelocalization.map_search.max_cells_per_side)) {
    throw std::invalid_argument("StructurePyramid: the points spread over more than 4 km");
  }
  corner_m_ = low - Eigen::Vector2f::Constant(kRelocalization.map_search.margin_m);
  size_ = (extent_m / kRelocalization.map_search.cell_m).array().ceil().cast<int>() + 1;
}

StructurePyramid::Grid StructurePyramid::MarkThings(std::span<const Eigen::Vector2f> points) const {
  Grid marked(IndexOf(0, size_.y(), size_), 0);
  for (const Eigen::Vector2f& point : points) {
    const Eigen::Vector2i at = CellOf(point);
    for (int y = at.y() - 1; y <= at.y() + 1; ++y) {
      for (int x = at.x() - 1; x <= at.x() + 1; ++x) {
        std::uint8_t& cell = marked[IndexOf(x, y, size_)];
        cell = std::max(cell, kNear);
      }
    }
    marked[IndexOf(at.x(), at.y(), size_)] = kThing;
  }
  return marked;
}

void StructurePyramid::BuildLevels(Grid marked) {
  constexpr int kLog2Cells = kRelocalization.map_search.log2_cells_per_block;
  Eigen::Vector2i marked_size = size_;
  for (int level = 0; level < kRelocalization.map_search.num_levels; ++level) {
    Level& added = levels_.emplace_back();
    added.shift = std::max(0, level - kLog2Cells);
    if (added.shift > 0) {
      const Eigen::Vector2i half = (marked_size.array() + 1) / 2;
      marked = Halved(marked, marked_size, half);
      marked_size = half;
    }
    // A block begins anywhere in a cell, so that it may touch one more than it is wide.
    added.tolerance = added.shift > 0 ? 1 << kLog2Cells : (1 << level) - 1;
    added.size = marked_size.array() + added.tolerance;
    added.grid = added.tolerance == 0 ? marked : Widened(marked, marked_size, added.tolerance);
  }
}

Eigen::Vector2i StructurePyramid::CellOf(const Eigen::Vector2f& point) const {
  return ((point - corner_m_) / kRelocalization.map_search.cell_m).array().floor().cast<int>();
}

Eigen::Vector2f StructurePyramid::CentreOf(const Eigen::Vector2i& cell) const {
  return corner_m_ +
         kRelocalization.map_search.cell_m * (cell.cast<float>().array() + 0.5f).matrix();
}

}  // namespace lio
