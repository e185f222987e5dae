// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Computes errors of motions instead of poses, which need no alignment of the worlds. The error of
// a motion from i to j is E = Inverse(Inverse(truth_i) truth_j) Inverse(estimate_i) estimate_j; its
// |translation| is in metres and its rotation angle in degrees. Path lengths are the truth's.
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

// Holds the errors from each pair to the next; pairs farther apart than 1.5 median intervals are
// left out.
struct StepErrors {
  RelativeErrors errors;
  double interval_s = 0;  // median interval; 0 when paired by index
};
[[nodiscard]] StepErrors ComputeStepErrors(const Association& association);

// Compares each pair with the one nearest to `interval_s` later, if it is within half a median
// interval of it. It is empty when paired by index, or when the recording is too short.
[[nodiscard]] std::optional<RelativeErrors> ComputeRpeOverTime(const Association& association,
                                                               double interval_s);

// Compares each pair with the first one whose path is longer by `length_m`. It is empty when the
// path is shorter.
[[nodiscard]] std::optional<RelativeErrors> ComputeRpeOverDistance(const PosePairs& pairs,
                                                                   double length_m);

// Holds the mean relative error of segments of many lengths, as in the KITTI odometry benchmark
// (Geiger et al., CVPR 2012, and its development kit): segments start one second (by index: ten
// rows) apart and are 100, 200 .. 800 m long; each error is divided by the segment's length and
// averaged over all segments.
struct SegmentErrors {
  double length_m = 0;
  int num_segments = 0;
  double translation_percent = 0;
  double rotation_deg_per_100m = 0;
};
struct Drift {
  // It is false for a path below 100 m, whose segments are a tenth as long (10 .. 80 m), and below
  // 10 m a hundredth.
  bool is_kitti_lengths = true;
  int num_segments = 0;  // 0: the path is too short for any
  double translation_percent = 0;
  double rotation_deg_per_100m = 0;
  std::vector<SegmentErrors> by_length;  // only lengths that fit
};
[[nodiscard]] Drift ComputeDrift(const Association& association);

// Returns the length of the path up to each pair [m].
[[nodiscard]] std::vector<double> PathLengths(const PosePairs& pairs);

}  // namespace lio
