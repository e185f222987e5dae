// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/point_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lio/base/median.hpp"
#include "lio/io/input_error.hpp"

namespace lio {
namespace {

constexpr std::array kUnits = {TimeUnit::kSeconds, TimeUnit::kMilliseconds, TimeUnit::kMicroseconds,
                               TimeUnit::kNanoseconds};
// A longer delay between stamp and reception means different clocks.
constexpr double kMaxDelaySeconds = 1.0;
constexpr double kEarliestDelaySeconds = -0.02;  // slightly negative delays are clock jitter
constexpr double kMaxFromStampSeconds = 10.0;    // points this far from their stamp are damage
// A sweep that begins later than this counts from some epoch, not from the stamp.
constexpr double kMinEpochSeconds = 1.0;
// A delay of this many sweeps or more means that the stamp is the start of the sweep. It is
// less than one, because the last returns of a sweep may be missing.
constexpr double kStartDelayRatio = 0.8;

bool IsSweep(double seconds) {
  return seconds >= kMinSweepSeconds && seconds <= kMaxSweepSeconds;
}

std::vector<double> Collect(const std::vector<CloudObservation>& clouds, auto&& value) {
  std::vector<double> values;
  values.reserve(clouds.size());
  for (const CloudObservation& cloud : clouds) values.push_back(value(cloud));
  return values;
}

TimeUnit ChooseUnit(double raw_span, std::optional<TimeUnit> wish) {
  if (wish) {
    const double seconds = raw_span * SecondsPer(*wish);
    if (IsSweep(seconds)) return *wish;
    throw InputError("with --point-time " + std::string(Name(*wish)) + " a sweep would last " +
                     fmt::format("{:.4g}", seconds) +
                     " s, which is not 5 to 500 ms: leave the unit to auto");
  }
  for (const TimeUnit unit : kUnits) {
    if (IsSweep(raw_span * SecondsPer(unit))) return unit;
  }
  throw InputError("the point times of a cloud span " + fmt::format("{:.6g}", raw_span) +
                   ", which is a sweep of 5 to 500 ms in no unit");
}

// Handles point times that count from an epoch: they are used as they are when it is the stamps'
// epoch.
TimeAnchor AnchorOfEpoch(const std::vector<CloudObservation>& clouds, double unit_s,
                         const PointTimeWishes& wishes, std::optional<double> imu_delay_s,
                         PointTimeRule& rule) {
  const auto stamp_s = [](const CloudObservation& c) {
    return 1e-9 * static_cast<double>(c.stamp.ns);
  };
  const double before = UpperMedian(Collect(
      clouds, [&](const CloudObservation& c) { return c.raw_first * unit_s - stamp_s(c); }));
  const double after = UpperMedian(
      Collect(clouds, [&](const CloudObservation& c) { return stamp_s(c) - c.raw_last * unit_s; }));
  const bool same_clock = std::abs(before) < kMaxDelaySeconds;
  if (same_clock) {
    const bool starts = std::abs(before) <= std::abs(after);
    rule.stamp = starts ? StampMeaning::kSweepStart : StampMeaning::kSweepEnd;
    rule.stamp_reason = "it is " + fmt::format("{:.3g}", 1e3 * std::abs(starts ? before : after)) +
                        " ms from the " + (starts ? "first" : "last") + " point's absolute time";
  } else {
    const StampJudgement judged = JudgeStamp(clouds, rule.sweep_s, imu_delay_s);
    rule.stamp = judged.meaning;
    rule.stamp_reason = judged.reason + "; the points' absolute clock is " +
                        fmt::format("{:.6g}", before) + " s from the stamps' and not used";
  }
  if (wishes.stamp) rule.stamp = *wishes.stamp;
  if (same_clock && !wishes.stamp) return TimeAnchor::kEpoch;
  return rule.stamp == StampMeaning::kSweepStart ? TimeAnchor::kFirstPoint : TimeAnchor::kLastPoint;
}

// Handles point times that count from the stamp, or back from it.
TimeAnchor AnchorOfOffsets(const std::vector<CloudObservation>& clouds, double unit_s,
                           const PointTimeWishes& wishes, std::optional<double> imu_delay_s,
                           PointTimeRule& rule) {
  const double last =
      unit_s * UpperMedian(Collect(clouds, [](const auto& c) { return c.raw_last; }));
  const double first =
      unit_s * UpperMedian(Collect(clouds, [](const auto& c) { return c.raw_first; }));
  constexpr double kSlack = 0.1;  // share of a sweep
  if (last < kSlack * rule.sweep_s) {
    rule.stamp = wishes.stamp.value_or(StampMeaning::kSweepEnd);
    rule.stamp_reason = "point times are negative, up to it";
    return rule.stamp == StampMeaning::kSweepEnd ? TimeAnchor::kStamp : TimeAnchor::kFirstPoint;
  }
  if (first < -kSlack * rule.sweep_s && !wishes.stamp) {
    rule.stamp_reason = "inside the sweep: point times lie on both sides of it";
    return TimeAnchor::kStamp;
  }
  const StampJudgement judged = JudgeStamp(clouds, rule.sweep_s, imu_delay_s);
  rule.stamp = wishes.stamp.value_or(judged.meaning);
  rule.stamp_reason = judged.reason;
  if (rule.stamp == StampMeaning::kSweepEnd) return TimeAnchor::kLastPoint;
  return first < -kSlack * rule.sweep_s ? TimeAnchor::kFirstPoint : TimeAnchor::kStamp;
}

std::int64_t ToNanoseconds(double raw, double unit_s) {
  // The whole units are converted first: an epoch time times 1e9 in one step would lose digits.
  const double per_unit = std::round(unit_s * 1e9);
  const double whole = std::floor(raw);
  return static_cast<std::int64_t>(whole * per_unit) + std::llround((raw - whole) * per_unit);
}

}  // namespace

std::string_view Name(TimeUnit unit) {
  constexpr std::array<std::string_view, 4> kNames = {"s", "ms", "us", "ns"};
  return kNames[static_cast<std::size_t>(unit)];
}

double SecondsPer(TimeUnit unit) {
  constexpr std::array kSeconds = {1.0, 1e-3, 1e-6, 1e-9};
  return kSeconds[static_cast<std::size_t>(unit)];
}

std::string_view Name(StampMeaning meaning) {
  return meaning == StampMeaning::kSweepStart ? "sweep start" : "sweep end";
}

StampJudgement JudgeStamp(const std::vector<CloudObservation>& clouds, double sweep_s,
                          std::optional<double> imu_delay_s) {
  const auto delays = Collect(
      clouds, [](const CloudObservation& c) { return SecondsBetween(c.stamp, c.received); });
  double delay = UpperMedian(delays);
  std::string what = "clouds come " + fmt::format("{:.4g}", 1e3 * delay) + " ms after their stamps";
  if (std::all_of(delays.begin(), delays.end(), [](double d) { return std::abs(d) < 1e-6; })) {
    return {StampMeaning::kSweepStart,
            "assumed: receive times equal the stamps and are no evidence (--stamp end if wrong)"};
  }
  const auto sane = [](double d) { return d >= kEarliestDelaySeconds && d <= kMaxDelaySeconds; };
  if (!sane(delay) && imu_delay_s) {
    delay -= *imu_delay_s;
    what = "clouds come " + fmt::format("{:.4g}", 1e3 * delay) +
           " ms after their stamps when the IMU's delay is taken as the clock offset";
  }
  if (!sane(delay)) {
    return {StampMeaning::kSweepStart,
            "assumed: the lidar and the recorder have different clocks (--stamp end if wrong)"};
  }
  const bool starts = delay >= kStartDelayRatio * sweep_s;
  return {starts ? StampMeaning::kSweepStart : StampMeaning::kSweepEnd,
          what + ", a sweep lasts " + fmt::format("{:.4g}", 1e3 * sweep_s) + " ms"};
}

std::optional<PointTimeRule> DetectPointTime(const std::vector<CloudObservation>& clouds,
                                             const PointTimeWishes& wishes,
                                             std::optional<double> imu_delay_s) {
  const double raw_span =
      UpperMedian(Collect(clouds, [](const auto& c) { return c.raw_last - c.raw_first; }));
  if (clouds.empty() || raw_span == 0.0) return {};
  PointTimeRule rule;
  rule.unit = ChooseUnit(raw_span, wishes.unit);
  const double unit_s = SecondsPer(rule.unit);
  rule.sweep_s = raw_span * unit_s;
  const double first =
      unit_s * UpperMedian(Collect(clouds, [](const auto& c) { return c.raw_first; }));
  rule.counts_from_epoch = std::abs(first) > kMinEpochSeconds;
  rule.anchor = rule.counts_from_epoch ? AnchorOfEpoch(clouds, unit_s, wishes, imu_delay_s, rule)
                                       : AnchorOfOffsets(clouds, unit_s, wishes, imu_delay_s, rule);
  if (wishes.stamp) rule.stamp_reason = "given by --stamp";
  if (!rule.counts_from_epoch) {
    std::vector<double> lasts = Collect(clouds, [&](const auto& c) { return unit_s * c.raw_last; });
    std::sort(lasts.begin(), lasts.end());
    rule.typical_last_s = lasts[(lasts.size() - 1) * 9 / 10];
  }
  return rule;
}

std::optional<std::vector<std::int64_t>> PointInstants(const PointTimeRule& rule, Timestamp stamp,
                                                       const std::vector<double>& raw) {
  if (raw.empty()) return std::vector<std::int64_t>();
  const double unit_s = SecondsPer(rule.unit);
  const auto [first, last] = std::minmax_element(raw.begin(), raw.end());
  double origin = 0.0;  // raw time to which the stamp refers
  if (rule.anchor == TimeAnchor::kEpoch) origin = 1e-9 * static_cast<double>(stamp.ns) / unit_s;
  if (rule.anchor == TimeAnchor::kFirstPoint) origin = *first;
  // The last returns of a sweep may be missing: then the stamp is later than its last point.
  if (rule.anchor == TimeAnchor::kLastPoint) {
    origin = rule.counts_from_epoch ? *last : std::max(*last, rule.typical_last_s / unit_s);
  }
  const bool is_sweep = (*last - *first) * unit_s <= kMaxSweepSeconds;
  const bool is_near_stamp = std::abs(*first - origin) * unit_s <= kMaxFromStampSeconds;
  if (!is_sweep || !is_near_stamp) return {};
  const bool absolute = rule.anchor == TimeAnchor::kEpoch;
  std::vector<std::int64_t> instants(raw.size());
  std::transform(raw.begin(), raw.end(), instants.begin(), [&](double time) {
    return absolute ? ToNanoseconds(time, unit_s) : stamp.ns + ToNanoseconds(time - origin, unit_s);
  });
  return instants;
}

}  // namespace lio
