// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "cloud_to_sweep.hpp"

#include <algorithm>

namespace lio {

CloudStatus CloudToSweep::Convert(const RosCloud& cloud, TimedSweep& sweep) {
  const auto layout = FindLayout(cloud.fields);
  if (!layout || (rules_->point_time && !layout->time)) return CloudStatus::kWrongFields;
  ReadPoints(cloud, *layout, points_);
  if (points_.size() == 0) return CloudStatus::kEmpty;
  const std::vector<std::uint16_t> rings = AssignRings(rules_->ring, points_);
  const auto instants = Instants(cloud, rings);
  if (!instants) return CloudStatus::kBadTime;
  std::vector<LidarPoint> points(points_.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].x_m = points_.x_m[i];
    points[i].y_m = points_.y_m[i];
    points[i].z_m = points_.z_m[i];
    points[i].intensity = QuantiseIntensity(rules_->intensity_scale * points_.intensity[i]);
    points[i].ring = rings.empty() ? std::uint16_t{0} : rings[i];
  }
  sweep = SortSweep(std::move(points), *instants);
  return CloudStatus::kOk;
}

std::optional<std::vector<std::int64_t>> CloudToSweep::Instants(
    const RosCloud& cloud, std::span<const std::uint16_t> rings) {
  if (rules_->point_time) return PointInstants(*rules_->point_time, cloud.stamp, points_.time);
  const UnwrappedSweep turned = UnwrapAzimuth(rules_->spin, points_, rings);
  spin_rate_.Add(cloud.stamp, turned, rules_->spin.direction);
  const bool stamp_is_end = rules_->spin_stamp.meaning == StampMeaning::kSweepEnd;
  auto instants = AzimuthInstants(turned, spin_rate_.radps(), cloud.stamp, stamp_is_end);
  const auto [first, last] = std::minmax_element(instants.begin(), instants.end());
  if (*last - *first > Duration::FromSeconds(kMaxSweepSeconds).ns) return {};
  return instants;
}

}  // namespace lio
