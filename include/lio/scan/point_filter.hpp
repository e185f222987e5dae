// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Selects usable returns: within the rig's range limits, and not the vehicle itself. Lidar frame,
// m.
#pragma once

#include <cmath>

#include "lio/base/rotation.hpp"
#include "lio/sensor/rig.hpp"
#include "lio/sensor/scan_chunk.hpp"

namespace lio {

inline bool IsFinite(const LidarPoint& point) {
  return std::isfinite(point.x_m + point.y_m + point.z_m);
}

class PointFilter {
 public:
  explicit PointFilter(const LidarRig& rig)
      : min_sq_(static_cast<float>(rig.min_range_m) * static_cast<float>(rig.min_range_m)),
        max_sq_(static_cast<float>(rig.max_range_m) * static_cast<float>(rig.max_range_m)),
        box_(rig.own_vehicle_box) {}

  // Needs a finite `point`.
  bool IsWanted(const LidarPoint& point) const { return IsInRange(point) && !IsOwnVehicle(point); }

  // It is branch-free, because the outcome is unpredictable.
  bool IsInRange(const LidarPoint& point) const {
    const float range_sq = point.x_m * point.x_m + point.y_m * point.y_m + point.z_m * point.z_m;
    return (range_sq >= min_sq_) & (range_sq <= max_sq_);
  }

  bool IsOwnVehicle(const LidarPoint& point) const {
    return box_ && box_->Contains(Vector3(point.x_m, point.y_m, point.z_m));
  }

 private:
  float min_sq_;
  float max_sq_;
  std::optional<OwnVehicleBox> box_;
};

}  // namespace lio
