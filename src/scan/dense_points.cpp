// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/dense_points.hpp"

#include <algorithm>

#include "scan/sampling.hpp"

namespace lio {

std::vector<ScanPoint> DensePoints(const Sweep& sweep, const PointFilter& filter) {
  const std::uint32_t share = SampleShare(sweep.points.size());
  std::vector<const LidarPoint*> chosen;
  chosen.reserve(kMaxSampled);
  for (const LidarPoint& point : sweep.points) {
    if (IsFinite(point) && Sample(point) < share && filter.IsWanted(point)) {
      chosen.push_back(&point);
    }
  }
  std::sort(chosen.begin(), chosen.end(),
            [](const LidarPoint* a, const LidarPoint* b) { return Precedes(*a, *b); });
  std::vector<ScanPoint> points;
  points.reserve(chosen.size());
  for (const LidarPoint* point : chosen) {
    points.push_back({{point->x_m, point->y_m, point->z_m}, point->t_offset_ns, point->ring});
  }
  return points;
}

}  // namespace lio
