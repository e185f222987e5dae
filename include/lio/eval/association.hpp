// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Which pose of the truth belongs to which pose of the estimate. Stamps of two recordings never
// meet: at the stamps of the sparser trajectory the denser one is interpolated (geodesic rotation,
// linear translation), but never across a gap wider than `max_gap`. KITTI files have no stamps:
// row i belongs to row i.
#pragma once

#include <optional>
#include <vector>

#include "lio/io/trajectory_file.hpp"

namespace lio {

struct PosePair {
  Timestamp stamp;  // by index: the row's index, in ns
  Pose truth;       // body in the truth's world
  Pose estimate;    // body in the estimate's world
};
using PosePairs = std::vector<PosePair>;  // stamps strictly increasing

enum class AssociationMethod { kTruthInterpolated, kEstimateInterpolated, kByIndex };

// Times are zero when associated by index.
struct Association {
  PosePairs pairs;
  AssociationMethod method = AssociationMethod::kTruthInterpolated;
  double max_gap_s = 0;
  bool is_max_gap_automatic = true;  // from the interpolated trajectory's median period
  double truth_period_s = 0;         // median
  double estimate_period_s = 0;      // median
  int num_truth = 0;
  int num_estimate = 0;
  int num_outside = 0;         // stamps before the first or after the last pose of the other
  int num_in_gap = 0;          // stamps inside a gap wider than max_gap
  int num_missing_frames = 0;  // estimates that its own rhythm (by index: the truth) would have
  double coverage_ratio = 0;   // share of the truth's time (rows) that the estimate covers, 0..1
};

// Throws std::runtime_error saying what to do when fewer than three pairs come out, when a stamped
// and an unstamped file differ in rows, or when a stamped file has a single pose.
Association Associate(const Trajectory& truth, const Trajectory& estimate,
                      std::optional<double> max_gap_s = std::nullopt);

// The pose of `poses` at `stamp`, interpolated across gaps of at most `max_gap_s`.
enum class LookUp { kFound, kOutside, kInGap };
LookUp InterpolateAt(const StampedPoses& poses, Timestamp stamp, double max_gap_s, Pose& pose);

// Median time between neighbours, s; 0 for fewer than two.
double MedianPeriod(const StampedPoses& poses);
// The widest gap that is interpolated across when nobody says otherwise, s.
double AutomaticMaxGap(double period_s);

}  // namespace lio
