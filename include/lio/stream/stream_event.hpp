// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Defines the stream's output: what the estimator consumes, in the order in which it must be
// consumed.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "lio/base/notice.hpp"
#include "lio/scan/sweep.hpp"
#include "lio/sensor/imu_sample.hpp"
#include "lio/stream/clock_step_arbiter.hpp"
#include "lio/stream/imu_preprocessor.hpp"

namespace lio {

// Gives an inertial sample in SI units and the imu's axes.
struct ImuReady {
  ImuSample sample;
  bool is_made_up = false;  // fills a gap of the stream: nothing is published at its time
};

// Gives a sweep that inertial samples cover. They will not change any more up to its end.
struct SweepReady {
  SweepPtr sweep;
};

// The inertial stream goes on elsewhere in time, after a gap of more than a second or a step of the
// clock. All sweeps before it have been matched; the stream's buffers are empty.
struct SegmentStarts {
  ImuSample first;  // SI units, imu's axes
  ImuPreprocessor::Step step = ImuPreprocessor::Step::kGap;
  std::optional<Timestamp> last_imu;  // the newest sample before it
};

// Stamps of all sensors went forward by less than a second: did time pass, or was the clock set?
struct AmbiguousClockStep {
  ClockStep stamps;
};

// No inertial samples come, or none come any more: lidar-only odometry from here on. All sweeps
// that samples cover have been matched.
struct ImuAbsent {
  Timestamp stamp;  // end of the first sweep that follows
  std::string evidence;
  Timestamp begin;                        // the sweep's
  Vector3 w_imu_radps = Vector3::Zero();  // the last rate that is known there
};

// After ImuAbsent inertial samples have come, or come again, the first of them at this time.
struct ImuAppeared {
  Timestamp first;
};

// No more messages come.
struct StreamEnded {};

using StreamEvent = std::variant<ImuReady, SweepReady, SegmentStarts, AmbiguousClockStep, ImuAbsent,
                                 ImuAppeared, StreamEnded, Notice>;

}  // namespace lio
