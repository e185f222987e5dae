// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds the configuration keys `loam_features.*`: when a point of a ring is an edge or a surface
// point. The last three belong to the paper's rule on unreliable points (Zhang and Singh, RSS 2014,
// section V-A), which A-LOAM leaves out.
#pragma once

namespace lio {

struct LoamFeatureOptions {
  // Features are picked from so many sectors of each ring separately, so that they surround the
  // vehicle. A-LOAM's.
  int num_sectors = 6;
  int num_sharp = 2;        // sharpest edge points of a sector; A-LOAM's
  int num_less_sharp = 20;  // edge points of a sector, the sharp ones included; A-LOAM's
  int num_flat = 4;         // flattest surface points of a sector; A-LOAM's
  // Edges lie above this |sum of differences to ten neighbours|^2, flats below. A-LOAM's.
  double curvature_m2 = 0.1;
  double leaf_m = 0.2;  // voxel edge and ring that keep one of the other surface points; A-LOAM's
  // Neighbours of a pick are the same feature up to this squared gap. A-LOAM's.
  double break_m2 = 0.05;
  // The far side may be occluded behind this range jump or a larger one. LOAM's published code: a
  // squared distance of 0.1 m^2.
  double min_occlusion_m = 0.3;
  // Beams farther apart than this do not shadow each other. LOAM's published code: 0.1 rad.
  double max_occlusion_gap_deg = 6;
  // Surfaces seen at less than this are left out, as grazing. Chosen: 2 cm of range noise moves a
  // point by 11 cm along the surface; more leaves the far walls of streets out.
  double min_incidence_deg = 10;
};

}  // namespace lio
