// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/association.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lio/eval/statistics.hpp"

namespace lio {
namespace {

constexpr std::size_t kMinPairs = 3;
// The truth counts as sparser when its period is longer than the estimate's by this factor.
constexpr double kSparserRatio = 1.5;
// The automatic max_gap allows a sample of the interpolated trajectory to be late, but none to be
// lost. Within a quarter of a second an acceleration of 1 m/s^2 bends a path by only 8 mm.
constexpr double kMaxGapPeriods = 1.5;
constexpr double kMinAutomaticGap_s = 0.25;
// Poses are missing between two estimates that are farther apart than this many periods.
constexpr double kMissingPeriods = 1.5;

void CountCoverage(const StampedPoses& truth, const StampedPoses& estimate, Association& result) {
  const double period_s = result.estimate_period_s;
  double covered_s = 0;
  for (std::size_t i = 1; i < estimate.size(); ++i) {
    const double step_s = SecondsBetween(estimate[i - 1].stamp, estimate[i].stamp);
    const bool is_gap = step_s > kMissingPeriods * period_s;
    if (is_gap) result.num_missing_frames += static_cast<int>(std::lround(step_s / period_s)) - 1;
    const Timestamp from = std::max(estimate[i - 1].stamp, truth.front().stamp);
    const Timestamp to = std::min(estimate[i].stamp, truth.back().stamp);
    const double inside_s = std::max(0.0, SecondsBetween(from, to));
    covered_s += is_gap ? std::min(inside_s, period_s) : inside_s;
  }
  result.coverage_ratio = covered_s / SecondsBetween(truth.front().stamp, truth.back().stamp);
}

std::string SpanText(const StampedPoses& poses) {
  return StampText(poses.front().stamp) + " .. " + StampText(poses.back().stamp) + " s";
}

void RequireTwoPoses(const StampedPoses& poses, const char* which) {
  if (poses.size() >= 2) return;
  throw std::runtime_error(fmt::format("the {} holds a single pose; give a trajectory", which));
}

Association AssociateByTime(const StampedPoses& truth, const StampedPoses& estimate,
                            std::optional<double> max_gap_s) {
  RequireTwoPoses(truth, "truth");
  RequireTwoPoses(estimate, "estimate");
  Association result;
  result.truth_period_s = MedianPeriod(truth);
  result.estimate_period_s = MedianPeriod(estimate);
  const bool is_truth_sparser = result.truth_period_s > kSparserRatio * result.estimate_period_s;
  result.method = is_truth_sparser ? AssociationMethod::kEstimateInterpolated
                                   : AssociationMethod::kTruthInterpolated;
  const StampedPoses& sampled = is_truth_sparser ? truth : estimate;
  const StampedPoses& interpolated = is_truth_sparser ? estimate : truth;
  const double period_s = is_truth_sparser ? result.estimate_period_s : result.truth_period_s;
  result.is_max_gap_automatic = !max_gap_s.has_value();
  result.max_gap_s = max_gap_s.value_or(AutomaticMaxGap(period_s));
  for (const StampedPose& sample : sampled) {
    Pose pose;
    const LookUp found = InterpolateAt(interpolated, sample.stamp, result.max_gap_s, pose);
    result.num_outside += found == LookUp::kOutside ? 1 : 0;
    result.num_in_gap += found == LookUp::kInGap ? 1 : 0;
    if (found != LookUp::kFound) continue;
    const Pose& truth_pose = is_truth_sparser ? sample.pose : pose;
    const Pose& estimate_pose = is_truth_sparser ? pose : sample.pose;
    result.pairs.push_back({sample.stamp, truth_pose, estimate_pose});
  }
  CountCoverage(truth, estimate, result);
  if (result.pairs.size() < kMinPairs) {
    throw std::runtime_error(fmt::format(
        "truth and estimate share {} instants, {} are needed: the truth covers {}, the estimate {}"
        "; check their clocks, or raise --max-gap ({:.3g} s) if the samples are sparse",
        result.pairs.size(), kMinPairs, SpanText(truth), SpanText(estimate), result.max_gap_s));
  }
  return result;
}

Association AssociateByIndex(const Trajectory& truth, const Trajectory& estimate) {
  const std::size_t num_rows = std::min(truth.poses.size(), estimate.poses.size());
  const bool are_both_unstamped = truth.format == estimate.format;
  if (!are_both_unstamped && truth.poses.size() != estimate.poses.size()) {
    throw std::runtime_error(fmt::format(
        "a KITTI file has no stamps and pairs row by row, but the truth has {} rows and the "
        "estimate {}; give both as TUM",
        truth.poses.size(), estimate.poses.size()));
  }
  if (num_rows < kMinPairs) {
    throw std::runtime_error(fmt::format("{} rows are too few, give at least {}", num_rows, 3));
  }
  Association result;
  result.method = AssociationMethod::kByIndex;
  for (std::size_t i = 0; i < num_rows; ++i) {
    const Timestamp index{static_cast<std::int64_t>(i)};
    result.pairs.push_back({index, truth.poses[i].pose, estimate.poses[i].pose});
  }
  const auto num_missing = static_cast<std::int64_t>(truth.poses.size() - num_rows);
  result.num_missing_frames = static_cast<int>(num_missing);
  result.num_outside = static_cast<int>(estimate.poses.size() - num_rows);
  result.coverage_ratio = static_cast<double>(num_rows) / static_cast<double>(truth.poses.size());
  return result;
}

}  // namespace

double MedianPeriod(const StampedPoses& poses) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    periods.push_back(SecondsBetween(poses[i - 1].stamp, poses[i].stamp));
  }
  return Median(std::move(periods));
}

LookUp InterpolateAt(const StampedPoses& poses, Timestamp stamp, double max_gap_s, Pose& pose) {
  const auto is_before = [](const StampedPose& p, Timestamp t) { return p.stamp < t; };
  const auto after = std::lower_bound(poses.begin(), poses.end(), stamp, is_before);
  if (after == poses.end()) return LookUp::kOutside;
  if (after->stamp == stamp) {
    pose = after->pose;
    return LookUp::kFound;
  }
  if (after == poses.begin()) return LookUp::kOutside;
  const StampedPose& before = *(after - 1);
  const double gap_s = SecondsBetween(before.stamp, after->stamp);
  if (gap_s > max_gap_s) return LookUp::kInGap;
  pose = Interpolate(before.pose, after->pose, SecondsBetween(before.stamp, stamp) / gap_s);
  return LookUp::kFound;
}

double AutomaticMaxGap(double period_s) {
  return std::max(kMaxGapPeriods * period_s, kMinAutomaticGap_s);
}

Association Associate(const Trajectory& truth, const Trajectory& estimate,
                      std::optional<double> max_gap_s) {
  const bool has_stamps =
      truth.format == TrajectoryFormat::kTum && estimate.format == TrajectoryFormat::kTum;
  Association result = has_stamps ? AssociateByTime(truth.poses, estimate.poses, max_gap_s)
                                  : AssociateByIndex(truth, estimate);
  result.num_truth = static_cast<int>(truth.poses.size());
  result.num_estimate = static_cast<int>(estimate.poses.size());
  return result;
}

}  // namespace lio
