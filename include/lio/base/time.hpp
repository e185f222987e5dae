// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds instants and spans of time as integer nanoseconds: stamps never lose digits, and only
// differences become seconds in floating point.
#pragma once

#include <cmath>
#include <compare>
#include <cstdint>

namespace lio {

struct Duration {
  std::int64_t ns = 0;

  static constexpr Duration FromSeconds(double seconds) {
    // Rounded half away from zero, by hand because std::llround is not constexpr.
    return {static_cast<std::int64_t>(seconds * 1e9 + (seconds < 0 ? -0.5 : 0.5))};
  }
  constexpr double Seconds() const { return static_cast<double>(ns) * 1e-9; }

  friend constexpr auto operator<=>(Duration, Duration) = default;
  friend constexpr Duration operator+(Duration a, Duration b) { return {a.ns + b.ns}; }
  friend constexpr Duration operator-(Duration a, Duration b) { return {a.ns - b.ns}; }
  friend constexpr Duration operator-(Duration a) { return {-a.ns}; }
};

constexpr Duration Abs(Duration d) {
  return d < Duration{} ? -d : d;
}

// Counts sensor time since the epoch of the sensor's clock, UNIX time where the source has it.
struct Timestamp {
  std::int64_t ns = 0;

  static constexpr Timestamp FromMicroseconds(std::int64_t utime) { return {utime * 1000}; }
  // Truncates toward minus infinity, as the wire's `utime` does.
  constexpr std::int64_t Microseconds() const {
    return ns >= 0 ? ns / 1000 : -((-ns + 999) / 1000);
  }

  friend constexpr auto operator<=>(Timestamp, Timestamp) = default;
  friend constexpr Timestamp operator+(Timestamp t, Duration d) { return {t.ns + d.ns}; }
  friend constexpr Timestamp operator-(Timestamp t, Duration d) { return {t.ns - d.ns}; }
  friend constexpr Duration operator-(Timestamp a, Timestamp b) { return {a.ns - b.ns}; }
};

// Returns the seconds from `from` to `to`.
constexpr double SecondsBetween(Timestamp from, Timestamp to) {
  return (to - from).Seconds();
}

}  // namespace lio
