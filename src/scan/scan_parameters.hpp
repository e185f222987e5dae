// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tunes thinning, deskewing and LOAM's features by constants without a configuration key; keys are
// in reduce_options.hpp and loam_feature_options.hpp. A comment gives the unit, the meaning and the
// source; a value marked "chosen" has no measurement behind it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lio {

struct ThinningParameters {
  // Points. Larger sweeps are sampled to about this many before thinning. Measured: 2.5 to 1.8 ms
  // on a sweep of 65 000 points, and several points are left to choose from in each voxel.
  std::size_t max_sampled = 32000;
  // The voxel edge changes by these factors at most from one sweep to the next. Chosen: follows
  // from a hall to a road within ten sweeps and does not answer to one sweep.
  double min_edge_ratio = 0.8;
  double max_edge_ratio = 1.25;
  // The table of voxels begins with so many slots. Chosen: three a target point; it grows as
  // needed.
  std::size_t initial_slots = 1u << 14;
};

struct DeskewParameters {
  // s. Transforms are blended linearly between poses of this grid. Physics: at 60 m and 1 rad/s the
  // chord errs by 60 m (1 rad/s 1 ms)^2 / 8 = 0.01 mm; 30 ms would be 4 mm off.
  double grid_step_s = 1e-3;
};

struct LoamFeatureParameters {
  // The curvature takes so many neighbours on each side. Zhang and Singh, RSS 2014; A-LOAM's
  // constant.
  int half_window = 5;
  // So many points of the far surface are left out at the border of a shadow. LOAM's published
  // code.
  std::size_t shadow_points = 6;
  // The slope of a surface is judged over so many steps on each side. Chosen: less judges the range
  // noise, more smooths edges away.
  std::size_t slope_half_window = 2;
  // A single step may have this share of the rise in a slope; more is a jump. Chosen: 0.25 is even,
  // 1 is a single jump; between, rough surfaces stay slopes.
  float max_step_share = 0.6f;
  // Edges are at most this share of the matched points. Chosen: edges are few and constrain
  // directions that surfaces leave free.
  int edge_divisor = 2;
};

struct MixedPixelParameters {
  // m, and share of the range. A return must lie so far from both surfaces: five times the range
  // noise of a spinning lidar (2 cm by the data sheets), and, chosen, 5 mm a metre for rough
  // ground. docs/experiments/mixed_pixels.md tells what is found and lost so.
  float tolerance_m = 0.1f;
  float tolerance_per_range = 0.005f;
  // Neighbouring beams are at most 1 deg apart, given as a cosine. Chosen: three beams of a coarse
  // lidar (OS1-64, 0.35 deg); beams farther apart see different things.
  float min_cos = 0.99985f;
  // Points of a ring that step back in time by no more than this are in the order of measurement as
  // they were sent: packets are stamped with jitter. Chosen: ten times the 0.1 ms that the sweeps
  // of KITTI scatter by.
  std::uint32_t max_jitter_ns = 1'000'000;
};

struct RangeNoiseParameters {
  std::size_t num_tried = 1000;  // points of a sweep; chosen by cost: some 20 us
  std::size_t min_points = 100;  // with two neighbours; chosen: 8 % of the noise
  // Statistics: a quarter of a point's offsets from the plane of its neighbours, whose noise is
  // sqrt(1.5) times that of a range, is below 0.39 of the range's standard deviation. The quarter
  // that is smoothest is of planes; edges and leaves are in the rest.
  float std_per_quartile = 2.56f;
  float rate = 0.05f;  // weight of a sweep in the mean; chosen: 2 s at 10 Hz
};

struct ScanParameters {
  ThinningParameters thinning;
  DeskewParameters deskew;
  LoamFeatureParameters loam;
  MixedPixelParameters mixed_pixels;
  RangeNoiseParameters range_noise;
};
inline constexpr ScanParameters kScanParameters{};

}  // namespace lio
