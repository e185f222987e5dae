// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "scan/ring_order.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <tuple>

#include "lio/scan/point_filter.hpp"

namespace lio {
namespace {

// Sorts one ring's indices unless they are in order, as they are from most sources.
template <class Less>
void SortIfNeeded(std::span<std::uint32_t> ring, const Less& less) {
  if (!std::is_sorted(ring.begin(), ring.end(), less)) std::sort(ring.begin(), ring.end(), less);
}

}  // namespace

bool LacksRings(std::span<const LidarPoint> points) {
  return std::all_of(points.begin(), points.end(), [](const auto& p) { return p.ring == 0; });
}

bool LacksTimes(std::span<const LidarPoint> points) {
  return std::all_of(points.begin(), points.end(), [&](const LidarPoint& point) {
    return point.t_offset_ns == points.front().t_offset_ns;
  });
}

std::vector<std::uint16_t> RingsFromElevation(std::span<const LidarPoint> points,
                                              std::span<const double> beam_elevations_rad) {
  if (beam_elevations_rad.empty()) throw std::invalid_argument("RingsFromElevation: no beams");
  // The tangent is monotonic in elevation, so the middles between beams are compared as tangents.
  std::vector<float> upper_tangent;
  for (std::size_t i = 0; i + 1 < beam_elevations_rad.size(); ++i) {
    const double middle = 0.5 * (beam_elevations_rad[i] + beam_elevations_rad[i + 1]);
    upper_tangent.push_back(static_cast<float>(std::tan(middle)));
  }
  std::vector<std::uint16_t> rings(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LidarPoint& p = points[i];
    if (!IsFinite(p)) continue;
    const float tangent = p.z_m / std::max(std::sqrt(p.x_m * p.x_m + p.y_m * p.y_m), 1e-6f);
    const auto above = std::upper_bound(upper_tangent.begin(), upper_tangent.end(), tangent);
    rings[i] = static_cast<std::uint16_t>(above - upper_tangent.begin());
  }
  return rings;
}

std::vector<float> TurnFractions(std::span<const LidarPoint> points) {
  constexpr float kTurn = 2.f * std::numbers::pi_v<float>;
  std::vector<float> fractions(points.size(), 0.f);
  const auto first = std::find_if(points.begin(), points.end(), IsFinite);
  if (first == points.end()) return fractions;
  const float start = std::atan2(first->y_m, first->x_m);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!IsFinite(points[i])) continue;
    const float turned = start - std::atan2(points[i].y_m, points[i].x_m);
    fractions[i] = (turned < 0.f ? turned + kTurn : turned) / kTurn;
  }
  return fractions;
}

RingOrder OrderByRing(std::span<const LidarPoint> points, std::span<const std::uint16_t> rings,
                      std::span<const std::uint8_t> is_wanted) {
  const auto ring_of = [&](std::size_t i) -> std::size_t {
    return rings.empty() ? points[i].ring : rings[i];
  };
  std::size_t num_rings = 0;
  for (std::size_t i = 0; i < points.size(); ++i) num_rings = std::max(num_rings, ring_of(i) + 1);

  RingOrder order;  // counting sort
  order.begin.assign(num_rings + 1, 0);
  for (std::size_t i = 0; i < points.size(); ++i) order.begin[ring_of(i) + 1] += is_wanted[i];
  for (std::size_t r = 0; r < num_rings; ++r) order.begin[r + 1] += order.begin[r];
  order.points.resize(order.begin.back());
  std::vector<std::uint32_t> next(order.begin.begin(), order.begin.end() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_wanted[i]) order.points[next[ring_of(i)]++] = static_cast<std::uint32_t>(i);
  }

  const bool lacks_times = LacksTimes(points);
  const std::vector<float> fraction = lacks_times ? TurnFractions(points) : std::vector<float>();
  const auto precedes = [&](std::uint32_t a, std::uint32_t b) {
    const LidarPoint& p = points[a];
    const LidarPoint& q = points[b];
    if (lacks_times && fraction[a] != fraction[b]) return fraction[a] < fraction[b];
    return std::tie(p.t_offset_ns, p.x_m, p.y_m, p.z_m) <
           std::tie(q.t_offset_ns, q.x_m, q.y_m, q.z_m);
  };
  for (std::size_t r = 0; r < num_rings; ++r) {
    SortIfNeeded(std::span(order.points).subspan(order.begin[r], order.ring(r).size()), precedes);
  }
  return order;
}

}  // namespace lio
