// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Configuration of the normal-distributions map and of its matcher.
#pragma once

#include <cstddef>

namespace lio {

inline constexpr std::size_t kMaxMapLevels = 4;

struct NdtOptions {
  double voxel_m = 1.0;     // edge of the largest cells; larger catches from farther
  int num_levels = 2;       // resolutions; each level's cells are half as large as the next one's
  int min_cell_points = 6;  // a cell with fewer points does not count
  // A cell with as many is frozen, and a scan that it matches shows nothing new. In narrow places
  // 100 come in two scans, all with the errors of these two.
  int max_cell_points = 2000;
  // Most matches take 2 to 4. One that comes back to a part of the map that is decimetres off takes
  // 10 to 60 small steps: with 12 a vehicle that closed a loop was lost.
  int max_iterations = 60;
  double converged_step_m = 1e-3;  // a step smaller than both of these ends the iteration
  double converged_step_rad = 1e-4;
  double min_surface_std_m = 0.03;  // floor of a cell's thickness; not below the range noise
  int max_cells = 400000;         // the map's memory bound; the least recently seen cells go first
  double max_distance_m = 200.0;  // cells farther from the vehicle are dropped
};

}  // namespace lio
