// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The configuration keys `loam_features.*`: when a point of a ring is an edge or a surface point.
// Defaults are A-LOAM's where it has the constant. The last three belong to the paper's rule on
// unreliable points (Zhang and Singh, RSS 2014, section V-A), which A-LOAM leaves out; they are
// chosen.
#pragma once

namespace lio {

struct LoamFeatureOptions {
  int num_sectors =
      6;              // of each ring, picked from separately, so that features surround the vehicle
  int num_sharp = 2;  // sharpest edge points of a sector
  int num_less_sharp = 20;    // edge points of a sector, the sharp ones included
  int num_flat = 4;           // flattest surface points of a sector
  double curvature_m2 = 0.1;  // |sum of differences to ten neighbours|^2: edges above, flats below
  double leaf_m = 0.2;        // voxel edge and ring that keep one of the other surface points
  double break_m2 = 0.05;     // squared gap up to which neighbours of a pick are the same feature
  double min_occlusion_m = 0.3;  // smallest range jump behind which the far side may be occluded
  double max_occlusion_gap_deg = 6;  // beams farther apart than this do not shadow each other
  double min_incidence_deg = 10;     // grazing incidence: surfaces at less than this are left out
};

}  // namespace lio
