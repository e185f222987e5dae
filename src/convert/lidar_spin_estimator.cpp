// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/lidar_spin_estimator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "azimuth_order.hpp"
#include "lio/base/angle.hpp"
#include "lio/base/median.hpp"
#include "lio/io/input_error.hpp"

namespace lio {
namespace {

constexpr double kOffsetBin = 2.0 * kBackwardSlack / LidarSpinEstimator::kNumOffsetBins;
constexpr double kMinHz = 1.0;
constexpr double kMaxHz = 100.0;

// Returns each angle minus the mean of the angles around it that are no outliers; NaN at both ends.
std::vector<double> DifferencesToMean(const std::vector<double>& angles,
                                      const std::vector<bool>& is_stray) {
  const std::size_t n = angles.size();
  std::vector<double> sum(n + 1, 0.0);
  std::vector<double> count(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    sum[i + 1] = sum[i] + (is_stray[i] ? 0.0 : angles[i]);
    count[i + 1] = count[i] + (is_stray[i] ? 0.0 : 1.0);
  }
  constexpr std::size_t kHalfWindow = 128;
  std::vector<double> differences(n, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = kHalfWindow; i + kHalfWindow < n; ++i) {
    const std::size_t begin = i - kHalfWindow;
    const std::size_t end = i + kHalfWindow + 1;
    differences[i] = angles[i] - (sum[end] - sum[begin]) / (count[end] - count[begin]);
  }
  return differences;
}

std::string_view Describe(PointOrder order) {
  switch (order) {
    case PointOrder::kFiring:
      return "points as fired";
    case PointOrder::kByRing:
      return "points ring by ring";
    case PointOrder::kNone:
      return "points in no order, cut behind the sensor";
  }
  return "";
}

}  // namespace

void LidarSpinEstimator::Add(const CloudPoints& points, std::span<const std::uint16_t> rings,
                             Timestamp stamp) {
  constexpr std::size_t kMinPoints = 500;
  if (points.size() < kMinPoints) return;
  const OrderVote vote = JudgeOrder(points, rings);
  Seen seen{.stamp = stamp, .order = vote.order, .direction = vote.direction};
  seen.coverage_ratio = CoverageOfCircle(points);
  SpinModel model;
  model.order = seen.order;
  model.direction = seen.direction;
  if (seen.order != PointOrder::kNone) {
    const UnwrappedSweep sweep = UnwrapAzimuth(model, points, rings);
    seen.first_azimuth_rad = sweep.first_azimuth_rad;
    seen.covered_rad = sweep.last_turned_rad;
    if (seen.order == PointOrder::kFiring && !rings.empty()) {
      AddOffsets(rings, seen, sweep);
    }
  }
  seen_.push_back(seen);
}

// In the order of firing, a ring's offset is its azimuth minus that of its neighbours in time in
// all rings.
void LidarSpinEstimator::AddOffsets(std::span<const std::uint16_t> rings, const Seen& seen,
                                    const UnwrappedSweep& sweep) {
  // The means are computed twice: the first ones identify outliers, which the second ones leave
  // out.
  std::vector<bool> is_stray(rings.size(), false);
  std::vector<double> difference = DifferencesToMean(sweep.turned_rad, is_stray);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    is_stray[i] = std::abs(difference[i]) > kBackwardSlack;
  }
  difference = DifferencesToMean(sweep.turned_rad, is_stray);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const double offset = seen.direction * difference[i];
    const double bin = std::floor((offset + kBackwardSlack) / kOffsetBin);
    if (!(bin >= 0.0 && bin < kNumOffsetBins)) continue;  // there is no mean here, or a gap is near
    if (rings[i] >= offsets_.size()) offsets_.resize(rings[i] + std::size_t{1});
    ++offsets_[rings[i]][static_cast<std::size_t>(bin)];
  }
}

SpinModel LidarSpinEstimator::Decide(const std::optional<BeamTable>& table) const {
  SpinModel model;
  std::array<int, 3> orders{};
  double direction_votes = 0.0;
  double coverage_ratio = 0.0;
  for (const Seen& seen : seen_) {
    ++orders[static_cast<std::size_t>(seen.order)];
    direction_votes += seen.direction;
    coverage_ratio += seen.coverage_ratio / static_cast<double>(seen_.size());
  }
  const auto most = std::max_element(orders.begin(), orders.end());
  model.order = seen_.empty() ? PointOrder::kNone : static_cast<PointOrder>(most - orders.begin());
  constexpr double kAllRound = 0.8;
  if (model.order == PointOrder::kNone && coverage_ratio < kAllRound) {
    throw InputError(
        "the clouds have no point time, and it cannot be rebuilt from azimuth: the points are in "
        "no known order and "
        "cover only " +
        fmt::format("{:.2g}", 100.0 * coverage_ratio) + " % of the circle");
  }
  const bool detected = model.order != PointOrder::kNone && direction_votes != 0.0;
  model.direction =
      detected ? (direction_votes > 0.0 ? 1.0 : -1.0) : (!table || table->clockwise ? -1.0 : 1.0);
  model.ring_offset_rad = RingOffsets();
  if (model.order != PointOrder::kFiring && table) {
    model.ring_offset_rad = table->azimuth_offset_rad;
  }
  std::string how;
  model.rate_radps = Rate(model.direction, model.order, table ? table->rotation_hz : 10.0, how);
  model.description = std::string(Describe(model.order)) + ", turning " +
                      (model.direction < 0 ? "clockwise" : "counter-clockwise") +
                      (detected ? ""
                       : table  ? " (as the model)"
                                : " (assumed)") +
                      " at " + fmt::format("{:.4f}", model.rate_radps / kTurn_rad) + " Hz" + how;
  return model;
}

// Empty when the offsets are no more than the turn between two firings: then beams have no offsets.
std::vector<double> LidarSpinEstimator::RingOffsets() const {
  std::vector<double> offsets;
  double largest = 0.0;
  for (const auto& histogram : offsets_) {
    const std::int64_t half = (std::accumulate(histogram.begin(), histogram.end(), 0) + 1) / 2;
    std::int64_t sum = 0;
    std::size_t median = 0;
    while (half > 0 && (sum += histogram[median]) < half) ++median;
    const double bins = half > 0 ? static_cast<double>(median) + 0.5 : 0.5 * kNumOffsetBins;
    offsets.push_back(bins * kOffsetBin - kBackwardSlack);
    largest = std::max(largest, std::abs(offsets.back()));
  }
  constexpr double kClear = 0.6 * kRadPerDeg;
  return largest > kClear ? offsets : std::vector<double>();
}

double LidarSpinEstimator::Rate(double direction, PointOrder order, double fallback_hz,
                                std::string& how) const {
  std::vector<double> turned;
  std::vector<double> seconds;
  std::vector<double> rates;
  for (std::size_t k = 1; k < seen_.size(); ++k) {
    const double dt = SecondsBetween(seen_[k - 1].stamp, seen_[k].stamp);
    const bool in_order = seen_[k].order == order && seen_[k - 1].order == order;
    if (dt <= 0.0 || !in_order) continue;
    const double turn =
        order == PointOrder::kNone
            ? kTurn_rad
            : TurnBetween(seen_[k - 1].first_azimuth_rad, seen_[k].first_azimuth_rad,
                          seen_[k - 1].covered_rad, direction);
    turned.push_back(turn);
    seconds.push_back(dt);
    rates.push_back(turn / dt);
  }
  const double typical = UpperMedian(rates);
  if (!(typical > kMinHz * kTurn_rad) || typical > kMaxHz * kTurn_rad) {
    how = " (assumed: the stamps do not determine the rate)";
    return fallback_hz * kTurn_rad;
  }
  double sum_turned = 0.0;
  double sum_seconds = 0.0;
  for (std::size_t k = 0; k < rates.size(); ++k) {
    constexpr double kMaxDeviation = 0.2;  // a larger one means that a sweep was lost
    if (std::abs(rates[k] / typical - 1.0) > kMaxDeviation) continue;
    sum_turned += turned[k];
    sum_seconds += seconds[k];
  }
  return sum_turned / sum_seconds;
}

}  // namespace lio
