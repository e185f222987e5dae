// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The configuration keys `reduce.*`: how a sweep is thinned before it is deskewed and matched. The
// numbers of points trade accuracy for time; docs/results.md has the speed at these.
#pragma once

namespace lio {

struct ReduceOptions {
  double voxel_m = 0.3;      // edge of the thinning grid for the first scan
  double min_voxel_m = 0.1;  // the edge then adapts from scan to scan between these two ...
  double max_voxel_m = 1.0;
  int target_points = 5000;  // ... to leave about this many points, which the map is made of
  int match_points = 2500;   // about this many of them are matched
};

}  // namespace lio
