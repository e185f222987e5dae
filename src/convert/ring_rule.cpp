// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/ring_rule.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lio {
namespace {

constexpr std::size_t kMaxRings = 1024;
constexpr std::int64_t kMinPointsOfRing = 20;  // fewer are not enough for a ring's elevation

double Elevation(const CloudPoints& points, std::size_t i) {
  return std::atan2(points.z_m[i], std::hypot(points.x_m[i], points.y_m[i]));
}

}  // namespace

void RingObserver::Elevations::Add(std::size_t number, double elevation_rad) {
  if (number >= kMaxRings) return;
  if (number >= sum_rad.size()) {
    sum_rad.resize(number + 1);
    count.resize(number + 1);
  }
  sum_rad[number] += elevation_rad;
  ++count[number];
}

// `order` is set to the source's way of counting, for the user.
std::vector<std::uint16_t> RingObserver::Elevations::RingOfSource(std::string& order) const {
  std::vector<std::uint16_t> seen;  // source numbers, ascending
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (count[i] >= kMinPointsOfRing) seen.push_back(static_cast<std::uint16_t>(i));
  }
  const auto mean = [&](std::uint16_t i) { return sum_rad[i] / static_cast<double>(count[i]); };
  std::size_t rises = 0;
  for (std::size_t k = 1; k < seen.size(); ++k) rises += mean(seen[k]) > mean(seen[k - 1]);
  const double rising_ratio =
      seen.size() < 2 ? 1.0 : static_cast<double>(rises) / static_cast<double>(seen.size() - 1);
  std::vector<std::uint16_t> rings(count.size());
  std::iota(rings.begin(), rings.end(), std::uint16_t{0});
  constexpr double kClear = 0.9;  // a few neighbours may be swapped by noise
  order = "counted from below";
  if (rising_ratio >= kClear) return rings;
  if (rising_ratio <= 1.0 - kClear) {
    order = "counted from above and therefore reversed";
    std::reverse(rings.begin(), rings.end());
    return rings;
  }
  order = "in no order and therefore sorted by measured elevation";
  std::sort(seen.begin(), seen.end(), [&](auto a, auto b) { return mean(a) < mean(b); });
  std::fill(rings.begin(), rings.end(), std::uint16_t{0});
  for (std::size_t k = 0; k < seen.size(); ++k) rings[seen[k]] = static_cast<std::uint16_t>(k);
  return rings;
}

void RingObserver::Add(const CloudPoints& points, std::uint32_t height, std::uint32_t width) {
  has_field_ |= !points.ring.empty();
  max_height_ = std::max(max_height_, height);
  max_width_ = std::max(max_width_, width);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double elevation = Elevation(points, i);
    if (!points.ring.empty()) {
      const std::int32_t ring = points.ring[i];
      field_is_ring_ &= ring >= 0 && ring < static_cast<std::int32_t>(kMaxRings);
      if (field_is_ring_) by_field_.Add(static_cast<std::size_t>(ring), elevation);
    }
    if (!points.row.empty()) {
      by_row_.Add(points.row[i], elevation);
      by_column_.Add(points.column[i], elevation);
    }
  }
}

RingRule RingObserver::Decide(const std::optional<BeamTable>& table) const {
  RingRule rule;
  std::string order;
  constexpr std::uint32_t kMaxOrganisedRings = 256;
  if (has_field_ && field_is_ring_ && by_field_.count.size() > 1) {
    rule.source = RingRule::Source::kField;
    rule.ring_of_source = by_field_.RingOfSource(order);
    rule.description = "from the ring field, " + order;
  } else if (table) {
    rule.source = RingRule::Source::kModel;
    rule.table = *table;
    rule.description = "from elevation, with the beams of " + table->model;
  } else if (by_row_.count.size() > 1 && max_height_ < max_width_ &&
             max_height_ <= kMaxOrganisedRings) {
    rule.source = RingRule::Source::kRow;
    rule.ring_of_source = by_row_.RingOfSource(order);
    rule.description = "from the cloud's rows, " + order;
  } else if (by_column_.count.size() > 1 && max_width_ < max_height_ &&
             max_width_ <= kMaxOrganisedRings) {
    rule.source = RingRule::Source::kColumn;
    rule.ring_of_source = by_column_.RingOfSource(order);
    rule.description = "from the cloud's columns, " + order;
  } else {
    rule.description = "the source has none: all points get 0 (--lidar MODEL rebuilds them)";
  }
  return rule;
}

std::vector<std::uint16_t> AssignRings(const RingRule& rule, const CloudPoints& points) {
  std::vector<std::uint16_t> rings;
  if (rule.source == RingRule::Source::kNone) return rings;
  rings.resize(points.size());
  if (rule.source == RingRule::Source::kModel) {
    for (std::size_t i = 0; i < rings.size(); ++i) {
      rings[i] = static_cast<std::uint16_t>(rule.table.NearestBeam(Elevation(points, i)));
    }
    return rings;
  }
  const auto map = [&](std::size_t number) {  // a ring not seen before keeps its number
    return number < rule.ring_of_source.size()
               ? rule.ring_of_source[number]
               : static_cast<std::uint16_t>(std::min(number, kMaxRings - 1));
  };
  for (std::size_t i = 0; i < rings.size(); ++i) {
    std::size_t number = 0;
    if (rule.source == RingRule::Source::kField) {
      number = i < points.ring.size() ? static_cast<std::size_t>(std::max(points.ring[i], 0)) : 0;
    } else if (!points.row.empty()) {
      number = rule.source == RingRule::Source::kRow ? points.row[i] : points.column[i];
    }
    rings[i] = map(number);
  }
  return rings;
}

}  // namespace lio
