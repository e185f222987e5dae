// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// How a sweep is thinned before it is deskewed and matched.
#pragma once

namespace lio {

struct ReduceOptions {
  double voxel_m = 0.5;  // largest edge of the thinning grid; smaller makes scans denser, slower
  double min_voxel_m = 0.1;  // smallest edge, reached indoors
  int target_points = 2500;  // the edge adapts from scan to scan to leave about this many points
};

}  // namespace lio
