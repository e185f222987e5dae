// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Errors of motions instead of poses: no alignment of worlds is involved. The error of a motion
// from i to j is
//   E = Inverse(Inverse(truth_i) truth_j) Inverse(estimate_i) estimate_j,
// with |translation| in metres and rotation angle in degrees. Path lengths are the truth's.
#pragma once

#include <optional>
#include <vector>

#include "lio/eval/association.hpp"
#include "lio/eval/statistics.hpp"

namespace lio {

struct RelativeErrors {
  ErrorStats translation_m;
  ErrorStats rotation_deg;
};

// From each pair to the next; pairs farther apart than 1.5 median intervals are left out.
struct StepErrors {
  RelativeErrors errors;
  double interval_s = 0;  // median; 0 by index
};
StepErrors ComputeStepErrors(const Association& association);

// From each pair to the one nearest to `interval_s` later, if it is within half a median interval
// of it. Empty by index, or when the recording is too short.
std::optional<RelativeErrors> ComputeRpeOverTime(const Association& association, double interval_s);

// From each pair to the first one whose path is longer by `length_m`. Empty when the path is
// shorter.
std::optional<RelativeErrors> ComputeRpeOverDistance(const PosePairs& pairs, double length_m);

// Mean relative error of segments of many lengths, as the KITTI odometry benchmark has it
// (Geiger et al., CVPR 2012, and its development kit): starts one second (by index: ten rows)
// apart, lengths 100, 200 .. 800 m, each error divided by its length, the mean over all segments.
struct SegmentErrors {
  double length_m = 0;
  int num_segments = 0;
  double translation_percent = 0;
  double rotation_deg_per_100m = 0;
};
struct Drift {
  // A path below 100 m is cut to tenths (10 .. 80 m), below 10 m to hundredths.
  bool is_kitti_lengths = true;
  int num_segments = 0;  // 0: path too short for any
  double translation_percent = 0;
  double rotation_deg_per_100m = 0;
  std::vector<SegmentErrors> by_length;  // only lengths that fit
};
Drift ComputeDrift(const Association& association);

// The path up to each pair, m.
std::vector<double> PathLengths(const PosePairs& pairs);

}  // namespace lio
