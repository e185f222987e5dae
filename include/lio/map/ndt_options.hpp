// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Configures the normal-distributions map and its matcher.
#pragma once

#include <cstddef>

namespace lio {

// A map has so many resolutions at most. Chosen: cells of 0.125 m with the default edge, which
// range noise fills.
inline constexpr std::size_t kMaxMapLevels = 4;

// NdtMatcher's map has so many resolutions more, of smaller cells, for narrow places. Measured:
// docs/experiments/narrow_places.md.
inline constexpr std::size_t kNumFinerLevels = 1;

// ... and so many more, of larger cells, for scans that find few surfaces in the others. Measured:
// docs/experiments/large_cells.md.
inline constexpr std::size_t kNumCoarserLevels = 1;

struct NdtOptions {
  // The largest cells have this edge; larger ones catch from farther, smaller ones hold two
  // surfaces less often. Chosen with num_levels: docs/experiments/narrow_places.md.
  double voxel_m = 1.0;
  // The map has so many resolutions; each level's cells are half as large as the next one's.
  // Measured: one loses metres in an office, three gain nothing
  // (docs/experiments/narrow_places.md).
  int num_levels = 2;
  // A cell with fewer points does not count. Chosen: a covariance of fewer has a normal by chance.
  int min_cell_points = 6;
  // A cell with as many is frozen, and a scan that it matches shows nothing new. In narrow places
  // 100 come in two scans, all with the errors of these two. Measured against 100:
  // docs/experiments/narrow_places.md.
  int max_cell_points = 2000;
  // Most matches take 2 to 4. One that comes back to a part of the map that is decimetres off takes
  // 10 to 60 small steps: with 12 a vehicle that closed a loop was lost. Measured:
  // docs/experiments/map_level.md.
  int max_iterations = 60;
  // A step smaller than both of these ends the iteration. Chosen: below a match's own standard
  // deviation of some millimetres; less costs an iteration.
  double converged_step_m = 1e-3;
  double converged_step_rad = 1e-4;
  // A cell's thickness counts as this at least. Chosen: range noise of 2 cm (data sheets) and
  // roughness; with less the flattest cells count for all.
  double min_surface_std_m = 0.03;
  // This bounds the map's memory; the least recently seen cells go first. Chosen: about 100 MB.
  int max_cells = 400000;
  // Cells farther from the vehicle are dropped. Chosen: beyond LidarRig::max_range_m.
  double max_distance_m = 200.0;
};

}  // namespace lio
