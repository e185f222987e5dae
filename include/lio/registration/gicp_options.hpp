// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Direct matching against keyframes.
#pragma once

namespace lio {

struct GicpOptions {
  double surface_std_m = 0.03;    // floor of a surface's thickness; not below the range noise
  double shape_voxel_m = 0.7;     // a point's normal is fitted over 3 x 3 x 3 voxels of this edge
  double shape_voxel_rad = 0.03;  // or of this share of its range, which is wider: three beams
  double keyframe_openness_ratio = 0.1;  // distance between keyframes over the median range
  double min_keyframe_m = 0.4;           // bounds of that distance
  double max_keyframe_m = 5.0;
  double keyframe_deg = 15.0;   // a rotation that makes a keyframe at any distance
  int num_near_keyframes = 20;  // the submap: the keyframes nearest to the guess,
  int num_hull_keyframes = 10;  // and the nearest ones on the convex hull of all keyframes
  int max_iterations = 15;
  double converged_step_m = 5e-4;  // a step smaller than both of these ends the iteration
  double converged_step_rad = 5e-5;
  int max_points = 1000000;       // memory bound; the keyframes longest unused go first
  double max_distance_m = 150.0;  // keyframes farther from the vehicle are dropped
};

}  // namespace lio
