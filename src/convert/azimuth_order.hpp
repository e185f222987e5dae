// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// In which order a cloud's points come, and which way the head turns: judged from one cloud.
#pragma once

#include <cmath>
#include <numbers>
#include <span>

#include "lio/convert/azimuth_time.hpp"

namespace lio {

// A point may lie this far behind the sweep's front: beams of one firing differ in azimuth.
inline constexpr double kBackwardSlack = std::numbers::pi / 6.0;

// Into [-pi, pi).
inline double WrappedAngle(double angle) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return angle - kTurn * std::floor(angle / kTurn + 0.5);
}
// Into [0, 2 pi).
inline double PositiveTurn(double angle) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return angle - kTurn * std::floor(angle / kTurn);
}

struct OrderVote {
  PointOrder order = PointOrder::kNone;
  double direction = 0.0;  // +1 counter-clockwise, -1 clockwise, 0 unknown
};

// `rings` is empty or has one ring per point.
OrderVote JudgeOrder(const CloudPoints& points, std::span<const std::uint16_t> rings);

// The share of ten-degree sectors that hold points.
double CoverageOfCircle(const CloudPoints& points);

}  // namespace lio
