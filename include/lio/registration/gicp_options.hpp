// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Configures direct matching against keyframes.
#pragma once

namespace lio {

struct GicpOptions {
  // A surface's thickness counts as this at least, which is not below the range noise. As
  // NdtOptions::min_surface_std_m.
  double surface_std_m = 0.03;
  // A point's normal is fitted over 3 x 3 x 3 voxels of this edge. Measured: 2.1 m
  // against 1.5 m (docs/experiments/gicp_and_ndt.md).
  double shape_voxel_m = 0.7;
  // It is this share of its range instead where that is wider. Chosen: three voxels hold three
  // beams 2 deg apart.
  double shape_voxel_rad = 0.03;
  // Keyframes are this share of the median range apart. Chosen; denser ones gained nothing
  // (docs/experiments/gicp_and_ndt.md).
  double keyframe_openness_ratio = 0.1;
  // This distance stays within these bounds. Chosen: half a step on foot, and DLO's published 5 m.
  double min_keyframe_m = 0.4;
  double max_keyframe_m = 5.0;
  // A rotation by this makes a keyframe at any distance. Chosen: less than DLO's published 45, so
  // that the walls behind a door are soon in the map.
  double keyframe_deg = 15.0;
  // So many keyframes nearest to the guess make up the submap. Chosen: twice DLO's published ten.
  int num_near_keyframes = 20;
  // So many of the nearest ones on the convex hull of all keyframes join them. DLO's published
  // value.
  int num_hull_keyframes = 10;
  int max_iterations = 15;  // chosen: matches with a sound guess end well before
  // A step smaller than both of these ends the iteration. Chosen: half of NDT's, since pairs hold
  // while nothing moves by GicpParameters::kKeepPairs_m.
  double converged_step_m = 5e-4;
  double converged_step_rad = 5e-5;
  // This bounds memory; the keyframes longest unused go first. Chosen: about 80 MB.
  int max_points = 1000000;
  // Keyframes farther from the vehicle are dropped. Chosen: beyond LidarRig::max_range_m.
  double max_distance_m = 150.0;
};

}  // namespace lio
