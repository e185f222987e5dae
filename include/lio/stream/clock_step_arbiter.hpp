// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The arbiter tells whether the lidar's clock stepped when the IMU's did, and whether a step forth
// is one at all or a gap. Both clocks step together if one host stamps both sensors; if each sensor
// has its own clock, one may step alone. The order in which messages come tells, since chunks of
// sweeps come a steady while after inertial samples of the same time. No wall clock is asked.
#pragma once

#include <deque>
#include <optional>

#include "lio/base/time.hpp"

namespace lio {

// Holds stamps of the inertial samples next to each other on both sides of a step.
struct ClockStep {
  Timestamp before;
  Timestamp after;
};

enum class LidarClock {
  kUnclear,  // the chunk may be of a sweep that began before the step
  kStepped,  // as well; or time has passed for both
  kSteady,
};

struct StepVerdict {
  LidarClock lidar = LidarClock::kUnclear;
  Timestamp after_by_lidar;  // when the first inertial sample after the step was taken
};

class ClockStepArbiter {
 public:
  // A chunk came, by its stamp, when the inertial stream was at `newest_imu` and in no doubt.
  void Note(Timestamp chunk, std::optional<Timestamp> newest_imu);
  // Did chunks come up to the second before that stamp of an inertial sample?
  bool SeesLidarAt(Timestamp imu) const;

  // Did time pass for the lidar up to a step forth, as it does in a gap of the inertial stream?
  bool HasTimePassed(const ClockStep& step) const;
  // Judges by a chunk that came after the step, when the inertial stream was at `newest_imu`.
  // Chunks are taken to come at once until it is known how long after the inertial samples they
  // come.
  StepVerdict Judge(const ClockStep& step, Timestamp chunk, Timestamp newest_imu) const;

 private:
  Duration Lag() const;

  std::deque<Timestamp> chunks_;  // the last few
  std::optional<Timestamp> newest_imu_;
  std::deque<Duration> lags_;  // lags of the last chunks behind the inertial stream
};

}  // namespace lio
