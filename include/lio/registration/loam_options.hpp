// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// LOAM's maps and matcher. A-LOAM's value is named where ours differs.
#pragma once

namespace lio {

enum class LoamTarget {
  kMap,   // against edge and surface maps grown from many scans
  kScan,  // against the scan before: lidar-only odometry, drifts faster
};

struct LoamOptions {
  LoamTarget target = LoamTarget::kMap;
  double edge_leaf_m = 0.4;        // voxel of the edge map: one point each
  double surface_leaf_m = 0.4;     // of the surface map (A-LOAM 0.8)
  int max_leaf_points = 20;        // a voxel with as many points is frozen
  int num_neighbours = 5;          // a line or a plane is laid through so many points; at most 8
  double min_line_ratio = 3.0;     // of the largest to the second eigenvalue of a line's points
  double max_plane_error_m = 0.2;  // a plane fits none of its points worse
  double huber_m = 0.1;            // residuals above count linearly
  double edge_std_m = 0.1;         // of an edge point's distance from its edge: the beams' gap
  double surface_std_m = 0.03;     // of a surface point's distance: range noise and roughness
  int max_iterations = 4;          // of Ceres in one round
  int max_rounds = 8;              // correspondences are sought anew in each (A-LOAM always 2)
  double converged_step_m = 1e-3;  // a round's step smaller than both ends the match
  double converged_step_rad = 1e-4;
  int max_leaves = 200000;        // each map's memory bound; the least recently seen go first
  double max_distance_m = 150.0;  // leaves farther from the vehicle are dropped
};

}  // namespace lio
