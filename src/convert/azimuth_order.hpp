// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Judges from one cloud the order in which its points come and the direction in which the head
// turns.
#pragma once

#include <cmath>
#include <numbers>
#include <span>

#include "lio/convert/azimuth_time.hpp"

namespace lio {

// A point may be this far behind the sweep's front, because beams of one firing differ in azimuth.
inline constexpr double kBackwardSlack = std::numbers::pi / 6.0;

// Wraps an angle into [-pi, pi).
[[nodiscard]] inline double WrappedAngle(double angle) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return angle - kTurn * std::floor(angle / kTurn + 0.5);
}
// Wraps an angle into [0, 2 pi).
[[nodiscard]] inline double PositiveTurn(double angle) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return angle - kTurn * std::floor(angle / kTurn);
}

struct OrderVote {
  PointOrder order = PointOrder::kNone;
  double direction = 0.0;  // +1 counter-clockwise, -1 clockwise, 0 unknown
};

// `rings` is empty or has one ring per point.
[[nodiscard]] OrderVote JudgeOrder(const CloudPoints& points, std::span<const std::uint16_t> rings);

// Returns the share of ten-degree sectors that hold points.
[[nodiscard]] double CoverageOfCircle(const CloudPoints& points);

}  // namespace lio
