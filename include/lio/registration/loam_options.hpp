// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// LOAM's maps and matcher.
#pragma once

namespace lio {

enum class LoamTarget {
  kMap,   // against edge and surface maps grown from many scans
  kScan,  // against the scan before: lidar-only odometry, drifts faster
};

struct LoamOptions {
  LoamTarget target = LoamTarget::kMap;  // chosen: it drifts less (docs/results.md)
  double edge_leaf_m = 0.4;              // voxel of the edge map: one point each; A-LOAM's
  // Voxel of the surface map. Chosen, A-LOAM has 0.8: more points to lay planes through indoors.
  double surface_leaf_m = 0.4;
  // A voxel with as many is frozen. Chosen: the mean of 20 has a quarter of the range noise.
  int max_leaf_points = 20;
  int num_neighbours = 5;  // a line or a plane is laid through so many points; at most 8; A-LOAM's
  double min_line_ratio = 3.0;     // largest to second eigenvalue of a line's points; A-LOAM's
  double max_plane_error_m = 0.2;  // a plane fits none of its points worse; A-LOAM's
  double huber_m = 0.1;            // residuals above count linearly; A-LOAM's
  // An edge point's distance from its edge has this standard deviation. Chosen: the beams' gap
  // decides where an edge is hit.
  double edge_std_m = 0.1;
  // A surface point's distance has this standard deviation. Chosen: range noise and roughness.
  double surface_std_m = 0.03;
  int max_iterations = 4;  // per round; A-LOAM's
  // Correspondences are sought anew in each. Chosen, A-LOAM always has 2: rounds end by converging.
  int max_rounds = 8;
  // A round's step smaller than both ends the match. Chosen: as NdtOptions.
  double converged_step_m = 1e-3;
  double converged_step_rad = 1e-4;
  // This bounds each map's memory; the least recently seen go first. Chosen: some ten megabytes.
  int max_leaves = 200000;
  // Leaves farther from the vehicle are dropped. Chosen: beyond LidarRig::max_range_m.
  double max_distance_m = 150.0;
};

}  // namespace lio
