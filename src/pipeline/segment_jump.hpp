// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The inertial stream goes on elsewhere in time: what has happened, and for how long is the motion
// unknown? A jump that is short enough is carried over, which means that the state goes on from
// where it was, at the new time, unsure of what happened in between:
//
//   kGap         samples are missing for less than 3 s: the body went straight on
//   kClockSet    the clock was set: the body is where it was, but samples may have been lost
//   kUnseen      all sensors were silent for longer, or their clocks were set: scans tell
//   kSetFarBack  the clock went back by 3 s or more, or another recording begins: scans tell
//
// outage.hpp is about the last two.
#pragma once

#include <cstdint>

#include "lio/filter/filter_history.hpp"
#include "lio/sensor/gap.hpp"
#include "lio/stream/stream_event.hpp"

namespace lio {

struct SegmentJumpParameters {
  // s. Samples of at most this time may be missing at a moment when a clock was set. Chosen: a
  // sweep at 10 Hz.
  double clock_set_s = kImuGap.unmeasured.Seconds();
};

inline constexpr SegmentJumpParameters kSegmentJump;

struct SegmentJump {
  enum class Kind : std::int8_t { kGap, kClockSet, kUnseen, kSetFarBack };
  Kind kind = Kind::kGap;
  double jump_s = 0.0;     // jump of the stamps
  double unknown_s = 0.0;  // kGap, kClockSet: the time of which nothing is known

  // The clock was set by so much, beyond the time that may have passed.
  [[nodiscard]] Duration set_by() const { return Duration::FromSeconds(jump_s - unknown_s); }
};

// `before` is the stamp of the filter's newest state.
[[nodiscard]] SegmentJump JudgeJump(Timestamp before, const SegmentStarts& segment);

// Returns the estimate at the segment's first sample after a gap or a clock that was set.
[[nodiscard]] Estimate CarriedOver(const Estimate& before, const SegmentJump& jump, Timestamp first,
                                   const HistoryOptions& options);

}  // namespace lio
