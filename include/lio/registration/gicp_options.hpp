// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Direct matching against keyframes.
#pragma once

namespace lio {

struct GicpOptions {
  double surface_std_m = 0.03;    // floor of a surface's thickness; not below the range noise
  double shape_voxel_m = 0.7;     // a point's shape is taken from three such voxels around it ...
  double shape_voxel_rad = 0.03;  // ... but three beams at the least: this much of its range
  double keyframe_openness_ratio = 0.1;  // a keyframe every so much of the place's openness, ...
  double min_keyframe_m = 0.4;           // ... at least this far apart ...
  double max_keyframe_m = 5.0;           // ... and at most, or
  double keyframe_deg = 15.0;            // after turning this much
  int num_near_keyframes = 20;           // the submap: keyframes nearest to the guess ...
  int num_hull_keyframes = 10;           // ... and those nearest among the convex hull of all
  int max_iterations = 15;
  double converged_step_m = 5e-4;  // a step smaller than both of these ends the iteration
  double converged_step_rad = 5e-5;
  int max_points = 1000000;       // memory bound; the keyframes longest unused go first
  double max_distance_m = 150.0;  // keyframes farther from the vehicle are dropped
};

}  // namespace lio
