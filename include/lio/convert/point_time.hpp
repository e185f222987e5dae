// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// What a driver's point times mean: their unit, whether they count from the cloud's stamp or from
// some epoch, and whether that stamp is the start or the end of the sweep. Decided once from the
// first clouds of a recording, by the data alone, and said in words.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lio/base/time.hpp"

namespace lio {

enum class TimeUnit { kSeconds, kMilliseconds, kMicroseconds, kNanoseconds };
std::string_view Name(TimeUnit unit);  // "s", "ms", "us", "ns"
double SecondsPer(TimeUnit unit);

enum class StampMeaning { kSweepStart, kSweepEnd };
std::string_view Name(StampMeaning meaning);  // "sweep start", "sweep end"

// How a raw point time becomes an instant.
enum class TimeAnchor {
  kEpoch,       // raw counts from the epoch of the stamps' clock
  kStamp,       // stamp + raw
  kFirstPoint,  // stamp + raw - first raw of the sweep
  kLastPoint,   // stamp + raw - last raw of the sweep
};

// One cloud of the first ones.
struct CloudObservation {
  Timestamp stamp;
  Timestamp received;
  double raw_first = 0.0;  // smallest and largest raw point time
  double raw_last = 0.0;
};

// What the user has laid down.
struct PointTimeWishes {
  std::optional<TimeUnit> unit = std::nullopt;
  std::optional<StampMeaning> stamp = std::nullopt;
};

struct StampJudgement {
  StampMeaning meaning = StampMeaning::kSweepStart;
  std::string reason;
};

// Judges the stamp from when clouds were received: a stamp of the sweep's start is older by at
// least a sweep. `imu_delay_s`: receive time minus stamp of the IMU, which tells the offset between
// sensor and host clock when the lidar's own delay is out of reason.
StampJudgement JudgeStamp(const std::vector<CloudObservation>& clouds, double sweep_s,
                          std::optional<double> imu_delay_s);

struct PointTimeRule {
  TimeUnit unit = TimeUnit::kSeconds;
  TimeAnchor anchor = TimeAnchor::kStamp;
  StampMeaning stamp = StampMeaning::kSweepStart;
  std::string stamp_reason;
  bool counts_from_epoch = false;  // raw times are instants of some clock
  double sweep_s = 0.0;            // median span of the points of a cloud
  double typical_last_s = 0.0;     // of kLastPoint: nearly every sweep's last point is before this
};

// Sweeps shorter or longer than this are none (a wrong unit is off by 1000).
inline constexpr double kMinSweepSeconds = 0.005;
inline constexpr double kMaxSweepSeconds = 0.5;

// Nothing when the times are all equal, as of drivers that fill the field with zeros: then azimuth
// must serve. Throws InputError when no unit (or not the wished one) makes a sweep 5 to 500 ms.
std::optional<PointTimeRule> DetectPointTime(const std::vector<CloudObservation>& clouds,
                                             const PointTimeWishes& wishes,
                                             std::optional<double> imu_delay_s);

// Instants of a cloud's points [ns], in the order of `raw`. Nothing when they are no sweep of at
// most 500 ms near the stamp: the message is damaged.
std::optional<std::vector<std::int64_t>> PointInstants(const PointTimeRule& rule, Timestamp stamp,
                                                       const std::vector<double>& raw);

}  // namespace lio
