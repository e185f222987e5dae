// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/eval/relative_error.hpp"

#include <algorithm>
#include <cmath>

#include "lio/base/angle.hpp"

namespace lio {
namespace {

constexpr double kMaxStepIntervals = 1.5;
constexpr double kDriftStart_s = 1.0;
constexpr std::size_t kDriftStartRows = 10;
constexpr int kNumDriftLengths = 8;
constexpr double kDriftLength_m = 100.0;

// Collects the errors of motions between pairs.
class Collector {
 public:
  explicit Collector(const PosePairs& pairs) : pairs_(pairs) {}

  void Add(std::size_t from, std::size_t to) {
    const PosePair &a = pairs_[from], &b = pairs_[to];
    const Pose truth = a.truth.Inverse() * b.truth;
    const Pose estimate = a.estimate.Inverse() * b.estimate;
    const Pose error = truth.Inverse() * estimate;
    translation_m_.push_back(error.translation.norm());
    rotation_deg_.push_back(LogSo3(error.rotation).norm() * kDegPerRad);
  }

  const std::vector<double>& translation_m() const { return translation_m_; }
  const std::vector<double>& rotation_deg() const { return rotation_deg_; }
  std::optional<RelativeErrors> Finish() const {
    if (translation_m_.empty()) return std::nullopt;
    return RelativeErrors{Summarise(translation_m_), Summarise(rotation_deg_)};
  }

 private:
  const PosePairs& pairs_;
  std::vector<double> translation_m_;
  std::vector<double> rotation_deg_;
};

double MedianInterval(const PosePairs& pairs) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    intervals.push_back(SecondsBetween(pairs[i - 1].stamp, pairs[i].stamp));
  }
  return Median(std::move(intervals));
}

// Returns the first pair whose path is longer than that of `from` by more than `length_m`, or the
// end.
std::size_t EndOfSegment(const std::vector<double>& path_m, std::size_t from, double length_m) {
  const auto begin = path_m.begin() + static_cast<std::ptrdiff_t>(from);
  const auto end = std::upper_bound(begin, path_m.end(), path_m[from] + length_m);
  return static_cast<std::size_t>(end - path_m.begin());
}

std::vector<std::size_t> DriftStarts(const Association& association) {
  const PosePairs& pairs = association.pairs;
  std::vector<std::size_t> starts;
  if (association.method == AssociationMethod::kByIndex) {
    for (std::size_t i = 0; i < pairs.size(); i += kDriftStartRows) starts.push_back(i);
    return starts;
  }
  const double half_interval_s = 0.5 * MedianInterval(pairs);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const bool is_due =
        starts.empty() || SecondsBetween(pairs[starts.back()].stamp, pairs[i].stamp) >
                              kDriftStart_s - half_interval_s;
    if (is_due) starts.push_back(i);
  }
  return starts;
}

double Mean(const std::vector<double>& values) {
  double sum = 0;
  for (double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace

std::vector<double> PathLengths(const PosePairs& pairs) {
  std::vector<double> path_m(pairs.size(), 0.0);
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const Vector3 step = pairs[i].truth.translation - pairs[i - 1].truth.translation;
    path_m[i] = path_m[i - 1] + step.norm();
  }
  return path_m;
}

StepErrors ComputeStepErrors(const Association& association) {
  const PosePairs& pairs = association.pairs;
  const double interval_s = MedianInterval(pairs);
  Collector collector(pairs);
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const double step_s = SecondsBetween(pairs[i - 1].stamp, pairs[i].stamp);
    if (step_s <= kMaxStepIntervals * interval_s) collector.Add(i - 1, i);
  }
  const bool has_time = association.method != AssociationMethod::kByIndex;
  return {collector.Finish().value_or(RelativeErrors{}), has_time ? interval_s : 0.0};
}

std::optional<RelativeErrors> ComputeRpeOverTime(const Association& association,
                                                 double interval_s) {
  if (association.method == AssociationMethod::kByIndex) return std::nullopt;
  const PosePairs& pairs = association.pairs;
  const double tolerance_s = 0.5 * MedianInterval(pairs);
  Collector collector(pairs);
  std::size_t to = 0;
  for (std::size_t from = 0; from < pairs.size(); ++from) {
    const auto off_s = [&](std::size_t i) {
      return std::abs(SecondsBetween(pairs[from].stamp, pairs[i].stamp) - interval_s);
    };
    while (to + 1 < pairs.size() && off_s(to + 1) <= off_s(to)) ++to;
    if (to > from && off_s(to) <= tolerance_s) collector.Add(from, to);
  }
  return collector.Finish();
}

std::optional<RelativeErrors> ComputeRpeOverDistance(const PosePairs& pairs, double length_m) {
  const std::vector<double> path_m = PathLengths(pairs);
  Collector collector(pairs);
  for (std::size_t from = 0; from < pairs.size(); ++from) {
    const std::size_t to = EndOfSegment(path_m, from, length_m);
    if (to < pairs.size()) collector.Add(from, to);
  }
  return collector.Finish();
}

Drift ComputeDrift(const Association& association) {
  const PosePairs& pairs = association.pairs;
  const std::vector<double> path_m = PathLengths(pairs);
  const std::vector<std::size_t> starts = DriftStarts(association);
  Drift drift;
  double unit_m = kDriftLength_m;
  if (path_m.back() <= unit_m) unit_m /= 10;
  if (path_m.back() <= unit_m) unit_m /= 10;
  drift.is_kitti_lengths = unit_m == kDriftLength_m;
  double translation_sum = 0, rotation_sum = 0;
  for (int i = 1; i <= kNumDriftLengths; ++i) {
    const double length_m = i * unit_m;
    Collector collector(pairs);
    for (std::size_t from : starts) {
      const std::size_t to = EndOfSegment(path_m, from, length_m);
      if (to < pairs.size()) collector.Add(from, to);
    }
    if (collector.translation_m().empty()) break;
    const auto count = static_cast<int>(collector.translation_m().size());
    const double translation_percent = Mean(collector.translation_m()) / length_m * 100;
    const double rotation_deg_per_100m = Mean(collector.rotation_deg()) / length_m * 100;
    drift.by_length.push_back({length_m, count, translation_percent, rotation_deg_per_100m});
    drift.num_segments += count;
    translation_sum += translation_percent * count;
    rotation_sum += rotation_deg_per_100m * count;
  }
  if (drift.num_segments > 0) {
    drift.translation_percent = translation_sum / drift.num_segments;
    drift.rotation_deg_per_100m = rotation_sum / drift.num_segments;
  }
  return drift;
}

}  // namespace lio
