// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds the points of a whole map as grids for larger and larger blocks of shifts: a cell says
// whether any shift of the block may have a point there, so that a search leaves out whole parts of
// the map at once. After W. Hess et al., "Real-Time Loop Closure in 2D LIDAR SLAM", ICRA 2016.
// Unlike theirs the grids have three dimensions, of which z may be flat; and a grid's cells grow
// with its blocks, to a quarter of their width, so that all grids take three times the memory of
// the finest; the bound is a little looser.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "lio/relocalization/parameters.hpp"

namespace lio {

class StructurePyramid {
 public:
  // Things seen from above: one layer of cells, whose z is 0. Throws std::invalid_argument when
  // they spread over more than 4 km.
  [[nodiscard]] static StructurePyramid FromAbove(std::span<const Eigen::Vector2f> things);
  // Points of a map that is small enough (IsOfBuilding()).
  [[nodiscard]] static StructurePyramid InBuilding(std::span<const Eigen::Vector3f> points);
  [[nodiscard]] static bool IsOfBuilding(std::span<const Eigen::Vector3f> points);

  [[nodiscard]] const MapSearchScale& scale() const { return scale_; }
  [[nodiscard]] bool is_flat() const { return is_flat_; }
  // Cells are counted from a corner beyond all points.
  [[nodiscard]] Eigen::Vector3i CellOf(const Eigen::Vector3f& point) const;
  [[nodiscard]] Eigen::Vector3f CentreOf(const Eigen::Vector3i& cell) const;
  // Returns the number of cells of the finest grid along each axis.
  [[nodiscard]] const Eigen::Vector3i& size() const { return size_; }
  // At level 0: is a point within reach of the cell? At level k: may one be, for `cell` moved by
  // anything from zero to 2^k - 1 cells along each axis?
  [[nodiscard]] bool MayStand(int level, const Eigen::Vector3i& cell) const {
    const Level& at = levels_[static_cast<std::size_t>(level)];
    const int x = (cell.x() >> at.shift) + at.tolerance;
    const int y = (cell.y() >> at.shift) + at.tolerance;
    const int z = (cell.z() >> at.shift) + (is_flat_ ? 0 : at.tolerance);
    return x >= 0 && y >= 0 && z >= 0 && x < at.size.x() && y < at.size.y() && z < at.size.z() &&
           at.grid[IndexOf(x, y, z, at.size)] != 0;
  }
  // Is a point in this very cell?
  [[nodiscard]] bool Stands(const Eigen::Vector3i& cell) const {
    return (cell.array() >= 0).all() && (cell.array() < size_.array()).all() &&
           levels_.front().grid[IndexOf(cell.x(), cell.y(), cell.z(), size_)] == kThing;
  }

 private:
  static constexpr std::uint8_t kNear = 1;  // a point is within reach
  static constexpr std::uint8_t kThing = 2;
  using Grid = std::vector<std::uint8_t>;  // row after row, layer after layer
  struct Level {
    int shift = 0;  // a cell is 2^shift of the finest ones wide
    // A block may lie this many cells further on; as many cells are before the first one.
    int tolerance = 0;
    Eigen::Vector3i size = Eigen::Vector3i::Zero();
    Grid grid;
  };

  StructurePyramid(std::span<const Eigen::Vector3f> points, const MapSearchScale& scale,
                   bool is_flat);
  static std::size_t IndexOf(int x, int y, int z, const Eigen::Vector3i& size) {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size.y()) +
            static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(size.x()) +
           static_cast<std::size_t>(x);
  }
  // Returns the finest grid, with the cells of the points and those within reach.
  [[nodiscard]] Grid MarkPoints(std::span<const Eigen::Vector3f> points) const;
  // Marks the cells within reach of a point.
  void MarkAround(const Eigen::Vector3f& point, Grid& marked) const;
  void BuildLevels(Grid marked);
  // Returns half as many cells along each axis; each is marked where any of its eight is.
  [[nodiscard]] static Grid Halved(const Grid& grid, const Eigen::Vector3i& size,
                                   const Eigen::Vector3i& half);
  // Marks the cells up to `tolerance` before each marked one, along an axis; the result begins as
  // many cells before the grid, and `size` becomes its size.
  [[nodiscard]] static Grid Widened(const Grid& grid, Eigen::Vector3i& size, int axis,
                                    int tolerance);

  MapSearchScale scale_;
  bool is_flat_;
  Eigen::Vector3f corner_m_ = Eigen::Vector3f::Zero();
  Eigen::Vector3i size_ = Eigen::Vector3i::Zero();
  std::vector<Level> levels_;
};

}  // namespace lio
