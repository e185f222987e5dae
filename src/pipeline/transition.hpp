// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The table of transitions between modes: the only ones there are. docs/design.md draws it, and a
// test checks that both agree.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "lio/imu/start_state.hpp"
#include "lio/pipeline/constant_velocity_tracker.hpp"
#include "pipeline/handover.hpp"

namespace lio {

enum class ModeKind : std::int8_t { kInitializing, kTracking, kLidarOnly, kRejected };

enum class Trigger : std::int8_t {
  kStarted,            // the first state is known
  kNoImu,              // no inertial samples come, and the motion is known roughly
  kRetry,              // the track is of no use: other convention, window over
  kSegmentStarts,      // after a gap of the inertial samples, or a step of their clock
  kContradicted,       // the configuration contradicts the data
  kLost,               // scans that see enough match nowhere
  kConventionDoubted,  // matching and IMU contradict each other
  kImuAppeared,        // inertial samples have come, after the lidar
  kImuAbsent,          // no inertial samples come any more
  kImuReturned,        // they come again, and the way was not lost meanwhile
  kImuDoubted,         // they contradict the motion that scans show
};

// A mode that leads to itself is built anew, but for Tracking, which goes on in place.
struct TransitionRule {
  ModeKind from;
  Trigger trigger;
  ModeKind to;
  bool is_restart;  // counted in num_restarts: what was known of the motion is begun anew
};

inline constexpr std::array kTransitions{
    TransitionRule{ModeKind::kInitializing, Trigger::kStarted, ModeKind::kTracking, false},
    TransitionRule{ModeKind::kInitializing, Trigger::kNoImu, ModeKind::kLidarOnly, false},
    TransitionRule{ModeKind::kInitializing, Trigger::kRetry, ModeKind::kInitializing, false},
    TransitionRule{ModeKind::kInitializing, Trigger::kSegmentStarts, ModeKind::kInitializing, true},
    TransitionRule{ModeKind::kInitializing, Trigger::kContradicted, ModeKind::kRejected, false},
    TransitionRule{ModeKind::kInitializing, Trigger::kImuAppeared, ModeKind::kInitializing, true},
    TransitionRule{ModeKind::kTracking, Trigger::kSegmentStarts, ModeKind::kTracking, true},
    TransitionRule{ModeKind::kTracking, Trigger::kLost, ModeKind::kInitializing, true},
    TransitionRule{ModeKind::kTracking, Trigger::kConventionDoubted, ModeKind::kInitializing, true},
    TransitionRule{ModeKind::kTracking, Trigger::kImuAbsent, ModeKind::kLidarOnly, true},
    TransitionRule{ModeKind::kTracking, Trigger::kImuDoubted, ModeKind::kLidarOnly, true},
    TransitionRule{ModeKind::kLidarOnly, Trigger::kImuReturned, ModeKind::kTracking, false},
    TransitionRule{ModeKind::kLidarOnly, Trigger::kLost, ModeKind::kInitializing, true},
    TransitionRule{ModeKind::kLidarOnly, Trigger::kImuAppeared, ModeKind::kInitializing, true},
};

// Absent: there is no such transition.
[[nodiscard]] constexpr std::optional<TransitionRule> FindRule(ModeKind from, Trigger trigger) {
  for (const TransitionRule& rule : kTransitions) {
    if (rule.from == from && rule.trigger == trigger) return rule;
  }
  return std::nullopt;
}

std::string_view NameOf(ModeKind kind);
std::string_view NameOf(Trigger trigger);

// A mode asks for the mode that follows it, and gives what that begins with.
struct Transition {
  Trigger trigger = Trigger::kRetry;
  Handover handover = {};
  // The filter knew this at kStarted, kImuReturned, kImuAbsent and kImuDoubted, biases and gravity
  // included.
  std::optional<StartState> start = std::nullopt;
  bool is_at_rest = false;     // kStarted: from a rest
  MotionSeed seed = {};        // kNoImu, kImuAbsent, kImuDoubted
  bool needs_new_map = false;  // kImuReturned: the place in the map is lost
  std::optional<Timestamp> initializing_since =
      std::nullopt;  // kRetry: the first sweep of the first try
};

}  // namespace lio
