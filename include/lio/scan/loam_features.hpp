// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// LOAM's feature extraction: selects the points of a sweep that lie on edges and on surfaces.
//
// Along each ring a point's curvature is c = |sum over five neighbours each side of (p_j - p_i)|^2.
// Each of six sectors of a ring gives its 2 sharpest points and up to 20 less sharp ones (c above
// the threshold), its 4 flattest, and the others, one per voxel, as less flat. Neighbours of a pick
// are not picked, up to the first break in the surface. Unreliable points are never picked: those
// at the border of an occlusion, whose edge belongs to the nearer surface and moves with the
// sensor, and those seen at grazing incidence.
//
// Inputs: points in the lidar frame, metres, in any order; a ring is put in order by time. If no
// point has a time, rings are put in order by azimuth, clockwise from the sweep's first finite
// point on. Non-finite and unwanted points (range, own vehicle) are ignored. Nothing throws. The
// result has indices into the sweep's points, by ring and then along the ring. It is the same set
// for any order of the points; without times, for any order that begins with the same finite point.
// Sources: Zhang and Singh, "LOAM", RSS 2014, section V-A; A-LOAM's constants. Differences: the
// surface's slope is judged by four steps of the ring together and against the beam's own angular
// step, so that neither range noise nor the sensor's resolution decides. The cost is linear but for
// sorting; the function is pure and safe from several threads.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lio/scan/loam_feature_options.hpp"
#include "lio/scan/sweep.hpp"
#include "lio/sensor/rig.hpp"

namespace lio {

struct LoamFeatures {
  std::vector<std::uint32_t> sharp;
  std::vector<std::uint32_t> less_sharp;  // includes the sharp ones
  std::vector<std::uint32_t> flat;
  std::vector<std::uint32_t> less_flat;  // one per voxel; may include flat ones
  std::vector<std::uint32_t> occluded;   // left out: at the border of an occlusion
  std::vector<std::uint32_t> grazed;     // left out: grazing incidence
  // Each point of the sweep has its ring here, rebuilt from elevation; empty where the sweep has
  // rings.
  std::vector<std::uint16_t> rebuilt_rings;
};

// `beam_elevations_rad` has the lowest beam first and is needed only for sweeps without rings (all
// points have ring 0): without it such a sweep has no features.
LoamFeatures ExtractLoamFeatures(const Sweep& sweep, const LoamFeatureOptions& options,
                                 const LidarRig& rig,
                                 std::span<const double> beam_elevations_rad = {});

}  // namespace lio
