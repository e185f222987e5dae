// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds the standing things of a whole map, seen from above, as grids for larger and larger blocks
// of shifts: a cell says whether any shift of the block may have a thing there, so that a search
// leaves out whole parts of the map at once. After W. Hess et al., "Real-Time Loop Closure in 2D
// LIDAR SLAM", ICRA 2016. Unlike theirs a grid's cells grow with its blocks, to a quarter of their
// width, so that all grids take three times the memory of the finest; the bound is a little looser.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace lio {

class StructurePyramid {
 public:
  // Throws std::invalid_argument when the points spread over more than 4 km.
  explicit StructurePyramid(std::span<const Eigen::Vector2f> points);

  // Cells are counted from a corner beyond all points.
  [[nodiscard]] Eigen::Vector2i CellOf(const Eigen::Vector2f& point) const;
  [[nodiscard]] Eigen::Vector2f CentreOf(const Eigen::Vector2i& cell) const;
  // Returns the number of cells of the finest grid along x and y.
  [[nodiscard]] const Eigen::Vector2i& size() const { return size_; }
  // At level 0: does a thing stand within a cell of there? At level k: may one, for `cell` moved by
  // anything from zero to 2^k - 1 cells along x and y?
  [[nodiscard]] bool MayStand(int level, const Eigen::Vector2i& cell) const {
    const Level& at = levels_[static_cast<std::size_t>(level)];
    const int x = (cell.x() >> at.shift) + at.tolerance;
    const int y = (cell.y() >> at.shift) + at.tolerance;
    return x >= 0 && y >= 0 && x < at.size.x() && y < at.size.y() &&
           at.grid[static_cast<std::size_t>(y) * static_cast<std::size_t>(at.size.x()) +
                   static_cast<std::size_t>(x)] != 0;
  }
  // Does a thing stand in this very cell?
  [[nodiscard]] bool Stands(const Eigen::Vector2i& cell) const {
    return cell.x() >= 0 && cell.y() >= 0 && cell.x() < size_.x() && cell.y() < size_.y() &&
           levels_.front()
                   .grid[static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(size_.x()) +
                         static_cast<std::size_t>(cell.x())] == kThing;
  }

 private:
  static constexpr std::uint8_t kNear = 1;  // a thing stands in a cell beside
  static constexpr std::uint8_t kThing = 2;
  using Grid = std::vector<std::uint8_t>;  // row after row
  struct Level {
    int shift = 0;  // a cell is 2^shift of the finest ones wide
    // A block may lie this many cells further on; as many cells are before the first one.
    int tolerance = 0;
    Eigen::Vector2i size = Eigen::Vector2i::Zero();
    Grid grid;
  };

  // Puts the corner and the size of the finest grid around the points.
  void Frame(std::span<const Eigen::Vector2f> points);
  // Returns the finest grid, with the cells of the points and those beside them.
  [[nodiscard]] Grid MarkThings(std::span<const Eigen::Vector2f> points) const;
  void BuildLevels(Grid marked);

  Eigen::Vector2f corner_m_ = Eigen::Vector2f::Zero();
  Eigen::Vector2i size_ = Eigen::Vector2i::Zero();
  std::vector<Level> levels_;
};

}  // namespace lio
