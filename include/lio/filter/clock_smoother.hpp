// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tells, when a run is over, what the offset between the clocks of lidar and IMU was at each scan:
// scans after it count, too. It is the smoother of Rauch, Tung and Striebel ("Maximum likelihood
// estimates of linear dynamic systems", AIAA Journal 3(8), 1965) over the estimates of ClockOffset:
// with F and Q those of the way from scan k to the next, x' = F x and P' = F P F' + Q,
//   x_k|all = x_k + P_k F' P'^-1 (x_k+1|all - x').
#pragma once

#include <optional>

#include "lio/filter/clock_estimate.hpp"

namespace lio {

class ClockSmoother {
 public:
  // Call from the last scan of a run to its first. `estimate` is what was known after that scan;
  // absent while the offset was not found: then what scans after it tell goes back to it at a
  // constant rate. Returns the offset as of `stamp`, in seconds; absent where no later scan tells
  // it either.
  [[nodiscard]] std::optional<double> Back(Timestamp stamp,
                                           const std::optional<ClockEstimate>& estimate);

 private:
  void GoBackTo(const ClockEstimate& before);

  std::optional<ClockEstimate> filtered_;  // as it was after the scan that was told last
  Eigen::Vector2d smoothed_ = Eigen::Vector2d::Zero();  // offset and rate at that time: (s, s/s)
};

}  // namespace lio
