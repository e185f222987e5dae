// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Holds what is known of d, the offset between two clocks (imu clock = lidar clock + d), and how it
// goes on: d grows at a constant rate, as two oscillators differ by some parts in a million, and
// walks at random besides.
#pragma once

#include <Eigen/Core>

#include "lio/base/time.hpp"

namespace lio {

// Holds what is known of d and its rate at one time: (s, s/s).
struct ClockEstimate {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d cov = Eigen::Matrix2d::Zero();
  Timestamp as_of;
};

// Returns the time between two scans in seconds. Stamps that go back, or on by too much, are those
// of clocks that were set: no time has passed.
[[nodiscard]] double PassedTime_s(Timestamp before, Timestamp now);
// Returns the matrix by which (d, its rate) go on in that time, which may be negative.
[[nodiscard]] Eigen::Matrix2d ClockTransition(double span_s);
// Returns what an estimate tells of a later time.
[[nodiscard]] ClockEstimate Predicted(const ClockEstimate& estimate, Timestamp now);

}  // namespace lio
