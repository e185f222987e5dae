// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/repeated_sweep.hpp"

#include <utility>

#include "lio/scan/reduced_scan.hpp"

namespace lio {

bool RepeatedSweepDetector::IsRepeated(const Sweep& sweep) {
  const std::size_t num_before = std::exchange(num_points_, sweep.points.size());
  const auto indices =
      SpreadIndices(sweep.points.size(), static_cast<int>(kRepeatedSweep.num_compared));
  bool is_same = !indices.empty() && num_before == num_points_;
  compared_.resize(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const LidarPoint& point = sweep.points[indices[i]];
    const LidarPoint before = std::exchange(compared_[i], point);
    is_same = is_same && before.x_m == point.x_m && before.y_m == point.y_m &&
              before.z_m == point.z_m && before.ring == point.ring;
  }
  return is_same;
}

}  // namespace lio
