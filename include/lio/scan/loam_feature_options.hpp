// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// What makes a point of a ring an edge or a surface point. Defaults are A-LOAM's where it has the
// constant; the last three belong to the rule that it leaves out.
#pragma once

namespace lio {

struct LoamFeatureOptions {
  int num_sectors = 6;  // of each ring, picked from alone, so that features surround the vehicle
  int num_sharp = 2;    // sharpest edge points of a sector
  int num_less_sharp = 20;    // edge points of a sector, the sharp ones included
  int num_flat = 4;           // flattest surface points of a sector
  double curvature_m2 = 0.1;  // |sum of differences to ten neighbours|^2: edges above, flats below
  double leaf_m = 0.2;        // of the other surface points one a voxel of this edge and ring stays
  double break_m2 = 0.05;     // neighbours of a pick count as the same feature up to a squared gap
  double min_occlusion_m = 0.3;      // a range jump from which the far side may lie in a shadow
  double max_occlusion_gap_deg = 6;  // beams farther apart than this do not shadow each other
  double min_incidence_deg = 10;     // a surface that the beams graze at less than this is left out
};

}  // namespace lio
