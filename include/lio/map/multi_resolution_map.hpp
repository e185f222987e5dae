// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Normal-distributions maps of several resolutions over one place: level 0 has the smallest cells,
// each next level cells twice as large. A point is matched at the finest level whose cell there
// shows a surface: small cells follow walls, kerbs and cars closely, large ones gather enough
// points where beams are far apart and on rough ground. Source: Magnusson, "The Three-Dimensional
// Normal-Distributions Transform", dissertation, Orebro 2009, section 6.3 (coarse to fine). The
// difference is that levels are chosen point by point, and not one after the other for the scan.
// Not safe for concurrent use while inserting.
#pragma once

#include <span>
#include <vector>

#include "lio/base/parallel.hpp"
#include "lio/map/gaussian_map.hpp"
#include "lio/map/ndt_options.hpp"

namespace lio {

class MultiResolutionMap {
 public:
  static constexpr std::int32_t kNoCell = GaussianMap::kNoCell;

  // Holds the range from one level to another, both included; the finest level is 0.
  struct Levels {
    std::size_t finest = 0;
    std::size_t coarsest = 0;
  };

  // Has the options' levels and so many finer and coarser ones. Throws std::invalid_argument when
  // an option is out of its range.
  explicit MultiResolutionMap(const NdtOptions& options, int num_finer = 0, int num_coarser = 0);

  // hits[i] is that of points_map[i] in the finest cell that shows a surface, among the levels;
  // kNoCell where none does. Vertical structures count at the coarsest of the levels alone: a part
  // of a wall that a small cell's side cuts off is as narrow and tall. Cells are numbered across
  // all levels.
  void FindAll(std::span<const Vector3> points_map, const Levels& levels,
               std::span<GaussianMap::Hit> hits) const;
  const SurfacePatch& patch(std::int32_t cell) const {
    return levels_[LevelOf(cell)].patch(InLevel(cell));
  }
  const CellBeams& beams(std::int32_t cell) const {
    return levels_[LevelOf(cell)].beams(InLevel(cell));
  }
  // Tells of the last scan that went into the cell's level.
  [[nodiscard]] float ShareOfLastScan(std::int32_t cell) const {
    return levels_[LevelOf(cell)].ShareOfLastScan(InLevel(cell));
  }
  [[nodiscard]] bool IsFrozen(std::int32_t cell) const {
    return levels_[LevelOf(cell)].IsFrozen(InLevel(cell));
  }
  // Returns the finest level whose cells are so large that a point may be off by `std_m`, one
  // sigma.
  [[nodiscard]] std::size_t LevelFor(double std_m) const;
  [[nodiscard]] std::size_t LevelOf(std::int32_t cell) const {
    return static_cast<std::size_t>(cell) % levels_.size();
  }

  void SetUp(const Vector3& up_map);
  // Sets the noise of ranges of the scans to come, 1 sigma [m].
  void SetRangeStd(double range_std_m);
  // Adds a scan taken from `sensor_map`, to all levels from `finest` on.
  void Insert(std::span<const Vector3> points_map, const Vector3& sensor_map,
              const Workers& workers = Workers(1), std::size_t finest = 0,
              const SeenBeams& beams = {});
  // Does the same as GaussianMap::InsertKept(), in all levels.
  void InsertKept(std::span<const Vector3> points_map, std::span<const Eigen::Vector3f> sides,
                  const Workers& workers = Workers(1));

  std::size_t num_levels() const { return levels_.size(); }
  std::size_t num_cells() const;
  // Returns an upper bound of cell numbers, for scratch arrays beside the map.
  std::size_t cell_capacity() const;
  std::size_t memory_bytes() const;

 private:
  struct Search;
  void FindIn(std::size_t level, bool is_coarsest, Search& search,
              std::span<GaussianMap::Hit> hits) const;
  [[nodiscard]] bool ShowsSurface(std::size_t level, bool is_coarsest,
                                  std::int32_t in_level) const {
    if (in_level == kNoCell) return false;
    const SurfacePatch& patch = levels_[level].patch(in_level);
    return patch.thickness_var > 0.f &&
           (is_coarsest || patch.kind != SurfacePatch::Kind::kVertical);
  }
  [[nodiscard]] std::int32_t Number(std::size_t level, std::int32_t in_level) const {
    return in_level * static_cast<std::int32_t>(levels_.size()) + static_cast<std::int32_t>(level);
  }
  std::int32_t InLevel(std::int32_t cell) const {
    return cell / static_cast<std::int32_t>(levels_.size());
  }

  std::vector<GaussianMap> levels_;  // finest first
  std::vector<double> edges_m_;
};

}  // namespace lio
