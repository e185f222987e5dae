// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/scan/mixed_pixels.hpp"

#include <algorithm>
#include <cmath>

#include "lio/scan/point_filter.hpp"
#include "scan/ring_order.hpp"
#include "scan/scan_parameters.hpp"

namespace lio {
namespace {

constexpr MixedPixelParameters kMixedPixels = kScanParameters.mixed_pixels;

Eigen::Vector3f PositionOf(const LidarPoint& point) {
  return {point.x_m, point.y_m, point.z_m};
}

// Does a point at `range_m` continue the surface of the two points beside it, `near_m` next to it
// and `next_m` one beam further? Missing ranges are zero.
bool Continues(float range_m, float near_m, float next_m, float tolerance_m) {
  if (next_m <= 0.f) return false;
  const float inverse = 2.f / near_m - 1.f / next_m;
  return inverse > 0.f && std::abs(1.f / inverse - range_m) < tolerance_m;
}

}  // namespace

void MixedPixelFinder::Load(const Sweep& sweep) {
  points_ = &sweep.points;
  neighbours_.clear();
  if (LacksRings(sweep.points)) return;
  if (!LinkAsSent()) LinkByOrder();
}

bool MixedPixelFinder::LinkAsSent() {
  const std::vector<LidarPoint>& points = *points_;
  neighbours_.assign(points.size(), {});
  newest_.assign(newest_.size(), kNone);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const std::size_t ring = points[i].ring;
    if (ring >= newest_.size()) newest_.resize(ring + 1, kNone);
    const std::uint32_t before = newest_[ring];
    newest_[ring] = i;
    neighbours_[i].before = before;
    if (before == kNone) continue;
    const std::uint32_t now_ns = points[i].t_offset_ns;
    const std::uint32_t before_ns = points[before].t_offset_ns;
    if (now_ns == before_ns || now_ns + kMixedPixels.max_jitter_ns < before_ns) return false;
    neighbours_[before].after = i;
  }
  return true;
}

void MixedPixelFinder::LinkByOrder() {
  const std::vector<LidarPoint>& points = *points_;
  neighbours_.assign(points.size(), {});
  const std::vector<std::uint8_t> is_wanted(points.size(), 1);
  const RingOrder order = OrderByRing(points, {}, is_wanted);
  for (std::size_t ring = 0; ring + 1 < order.begin.size(); ++ring) {
    const auto indices = order.ring(ring);
    for (std::size_t i = 1; i < indices.size(); ++i) {
      neighbours_[indices[i]].before = indices[i - 1];
      neighbours_[indices[i - 1]].after = indices[i];
    }
  }
}

// Returns the range of a point if it lies beside `direction`, else zero.
float MixedPixelFinder::RangeBeside(const Eigen::Vector3f& direction, std::uint32_t index) const {
  if (index == kNone) return 0.f;
  const Eigen::Vector3f position = PositionOf((*points_)[index]);
  const float range_m = position.norm();
  return position.dot(direction) > kMixedPixels.min_cos * range_m ? range_m : 0.f;
}

std::optional<float> MixedPixelFinder::OffsetFromPlane(std::uint32_t index) const {
  if (neighbours_.empty()) return std::nullopt;
  const Eigen::Vector3f position = PositionOf((*points_)[index]);
  const float range_m = position.norm();
  const float before_m = RangeBeside(position / range_m, neighbours_[index].before);
  const float after_m = RangeBeside(position / range_m, neighbours_[index].after);
  // A point that is not finite compares false.
  if (!(before_m > 0.f && after_m > 0.f && range_m > 0.f)) return std::nullopt;
  return range_m - 2.f / (1.f / before_m + 1.f / after_m);
}

bool MixedPixelFinder::IsMixed(std::uint32_t index) const {
  if (neighbours_.empty()) return false;
  const Neighbours& beside = neighbours_[index];
  const Eigen::Vector3f position = PositionOf((*points_)[index]);
  const float range_m = position.norm();
  const Eigen::Vector3f direction = position / range_m;
  const float before_m = RangeBeside(direction, beside.before);
  const float after_m = RangeBeside(direction, beside.after);
  if (before_m <= 0.f || after_m <= 0.f) return false;
  const float tolerance_m = kMixedPixels.tolerance_m + kMixedPixels.tolerance_per_range * range_m;
  if (std::min(before_m, after_m) + tolerance_m > range_m ||
      std::max(before_m, after_m) - tolerance_m < range_m) {
    return false;
  }
  const float second_before_m = RangeBeside(direction, neighbours_[beside.before].before);
  const float second_after_m = RangeBeside(direction, neighbours_[beside.after].after);
  return !Continues(range_m, before_m, second_before_m, tolerance_m) &&
         !Continues(range_m, after_m, second_after_m, tolerance_m);
}

}  // namespace lio
