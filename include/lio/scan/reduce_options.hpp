// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds the configuration keys `reduce.*`: how a sweep is thinned before it is deskewed and
// matched. The numbers of points trade accuracy for time; docs/results.md has the speed at these.
#pragma once

namespace lio {

struct ReduceOptions {
  double voxel_m = 0.3;  // edge of the thinning grid for the first scan; chosen: it adapts at once
  // The edge then adapts from scan to scan between these two ... Chosen: some times the range
  // noise, and the edge of the map's largest cells (NdtOptions::voxel_m).
  double min_voxel_m = 0.1;
  double max_voxel_m = 1.0;
  // ... to leave about this many points, which the map is made of. Chosen: fewer leave cells
  // without a shape, and more take longer.
  int target_points = 5000;
  // About this many of them are matched. Chosen: half of them, for the time of a match.
  int match_points = 2500;
};

}  // namespace lio
