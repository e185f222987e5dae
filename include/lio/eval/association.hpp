// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Pairs the poses of truth and estimate. The stamps of two recordings never coincide, so the denser
// trajectory is interpolated at the stamps of the sparser one (geodesic rotation, linear
// translation), but never across a gap wider than `max_gap`. KITTI files have no stamps: row i is
// paired with row i.
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

// All times are zero when paired by index.
struct Association {
  PosePairs pairs;
  AssociationMethod method = AssociationMethod::kTruthInterpolated;
  double max_gap_s = 0;
  bool is_max_gap_automatic = true;  // chosen from the interpolated trajectory's median period
  double truth_period_s = 0;         // median
  double estimate_period_s = 0;      // median
  int num_truth = 0;
  int num_estimate = 0;
  int num_outside = 0;  // stamps before the first or after the last pose of the other trajectory
  int num_in_gap = 0;   // stamps inside a gap wider than max_gap
  int num_missing_frames =
      0;  // estimates missing from its own rhythm (by index: from the truth's rows)
  double coverage_ratio =
      0;  // share of the truth's time (by index: rows) that the estimate covers, 0..1
};

// Throws std::runtime_error that says what to do when there are fewer than three pairs, when a
// stamped and an unstamped file differ in rows, or when a stamped file has a single pose.
[[nodiscard]] Association Associate(const Trajectory& truth, const Trajectory& estimate,
                                    std::optional<double> max_gap_s = std::nullopt);

// Interpolates `poses` at `stamp`, across gaps of at most `max_gap_s`.
enum class LookUp { kFound, kOutside, kInGap };
[[nodiscard]] LookUp InterpolateAt(const StampedPoses& poses, Timestamp stamp, double max_gap_s,
                                   Pose& pose);

// Returns the median time between neighbours [s]; 0 for fewer than two poses.
[[nodiscard]] double MedianPeriod(const StampedPoses& poses);
// Returns the widest gap [s] that is interpolated across when the user gives none.
[[nodiscard]] double AutomaticMaxGap(double period_s);

}  // namespace lio
