// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Finds what a driver's point times mean: their unit, whether they count from the cloud's stamp or
// from some epoch, and whether that stamp is the start or the end of the sweep. This is decided
// once, from the data of the first clouds of a recording alone, and reported in words.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lio/base/time.hpp"

namespace lio {

enum class TimeUnit { kSeconds, kMilliseconds, kMicroseconds, kNanoseconds };
[[nodiscard]] std::string_view Name(TimeUnit unit);  // "s", "ms", "us", "ns"
[[nodiscard]] double SecondsPer(TimeUnit unit);

enum class StampMeaning { kSweepStart, kSweepEnd };
[[nodiscard]] std::string_view Name(StampMeaning meaning);  // "sweep start", "sweep end"

// Says how a raw point time becomes an instant.
enum class TimeAnchor {
  kEpoch,       // raw counts from the epoch of the stamps' clock
  kStamp,       // stamp + raw
  kFirstPoint,  // stamp + raw - first raw of the sweep
  kLastPoint,   // stamp + raw - last raw of the sweep
};

// Holds what is needed of one of the first clouds.
struct CloudObservation {
  Timestamp stamp;
  Timestamp received;
  double raw_first = 0.0;  // smallest and largest raw point time
  double raw_last = 0.0;
};

// Holds what the user has prescribed.
struct PointTimeWishes {
  std::optional<TimeUnit> unit = std::nullopt;
  std::optional<StampMeaning> stamp = std::nullopt;
};

struct StampJudgement {
  StampMeaning meaning = StampMeaning::kSweepStart;
  std::string reason;
};

// Judges the meaning of the stamp from the clouds' receive times: a stamp at the sweep's start is
// older by at least a sweep. `imu_delay_s` is the receive time minus the stamp of the IMU; it gives
// the offset between sensor and host clock when the lidar's own delay is implausible.
[[nodiscard]] StampJudgement JudgeStamp(const std::vector<CloudObservation>& clouds, double sweep_s,
                                        std::optional<double> imu_delay_s);

struct PointTimeRule {
  TimeUnit unit = TimeUnit::kSeconds;
  TimeAnchor anchor = TimeAnchor::kStamp;
  StampMeaning stamp = StampMeaning::kSweepStart;
  std::string stamp_reason;
  bool counts_from_epoch = false;  // raw times are instants on some clock
  double sweep_s = 0.0;            // median time span of a cloud's points
  double typical_last_s =
      0.0;  // for kLastPoint: the last point of nearly every sweep is before this
};

// Spans outside these limits are not taken for sweeps (a wrong unit is off by 1000).
inline constexpr double kMinSweepSeconds = 0.005;
inline constexpr double kMaxSweepSeconds = 0.5;

// Returns nothing when all times are equal, because some drivers fill the field with zeros: then
// azimuth must serve. Throws InputError when no unit (or not the prescribed one) makes a sweep of 5
// to 500 ms.
[[nodiscard]] std::optional<PointTimeRule> DetectPointTime(
    const std::vector<CloudObservation>& clouds, const PointTimeWishes& wishes,
    std::optional<double> imu_delay_s);

// Returns the instants of a cloud's points [ns], in the order of `raw`. Returns nothing when they
// form no sweep of at most 500 ms near the stamp: the message is damaged.
[[nodiscard]] std::optional<std::vector<std::int64_t>> PointInstants(
    const PointTimeRule& rule, Timestamp stamp, const std::vector<double>& raw);

}  // namespace lio
