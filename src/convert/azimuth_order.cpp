// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "azimuth_order.hpp"

#include <algorithm>
#include <array>

#include "lio/base/angle.hpp"

namespace lio {
namespace {

// Counts steps of azimuth by sign; tiny ones (two returns of one beam) and jumps are not counted.
struct Steps {
  std::size_t forward = 0;
  std::size_t backward = 0;

  void Add(double step, double max_step) {
    if (std::abs(step) < 1e-5 || std::abs(step) > max_step) return;
    ++(step > 0.0 ? forward : backward);
  }
  std::size_t num() const { return forward + backward; }
  double direction() const { return forward > backward ? 1.0 : -1.0; }
  double agreement() const {
    return num() == 0
               ? 0.0
               : static_cast<double>(std::max(forward, backward)) / static_cast<double>(num());
  }
};

double Azimuth(const CloudPoints& points, std::size_t i) {
  return std::atan2(points.y_m[i], points.x_m[i]);
}

OrderVote JudgeWithRings(const CloudPoints& points, std::span<const std::uint16_t> rings) {
  const std::size_t num_rings = std::size_t{*std::max_element(rings.begin(), rings.end())} + 1;
  std::vector<std::optional<double>> last(num_rings);
  Steps steps;
  std::size_t num_same_ring = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double azimuth = Azimuth(points, i);
    auto& before = last[rings[i]];
    if (before) steps.Add(WrappedAngle(azimuth - *before), 20.0 * kRadPerDeg);
    before = azimuth;
    if (i > 0 && rings[i] == rings[i - 1]) ++num_same_ring;
  }
  constexpr double kAgreement = 0.9;
  const bool ordered = steps.agreement() > kAgreement && steps.num() > points.size() / 4;
  if (!ordered) return {};
  const bool by_ring = num_same_ring > points.size() / 2;
  return {by_ring ? PointOrder::kByRing : PointOrder::kFiring, steps.direction()};
}

// Judges clouds without rings: when all rings turn together, points a hundredth of the cloud apart
// are some degrees apart, always in one direction.
OrderVote JudgeWithoutRings(const CloudPoints& points) {
  const std::size_t lag = std::max<std::size_t>(16, points.size() / 100);
  Steps steps;
  for (std::size_t i = lag; i < points.size(); ++i) {
    const double step = WrappedAngle(Azimuth(points, i) - Azimuth(points, i - lag));
    if (std::abs(step) > 0.5 * kRadPerDeg) steps.Add(step, 30.0 * kRadPerDeg);
  }
  constexpr double kAgreement = 0.8;
  const bool ordered = steps.agreement() > kAgreement && steps.num() > points.size() / 2;
  return ordered ? OrderVote{PointOrder::kFiring, steps.direction()} : OrderVote{};
}

}  // namespace

OrderVote JudgeOrder(const CloudPoints& points, std::span<const std::uint16_t> rings) {
  if (points.size() < 2) return {};
  return rings.empty() ? JudgeWithoutRings(points) : JudgeWithRings(points, rings);
}

double CoverageOfCircle(const CloudPoints& points) {
  std::array<bool, 36> seen{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double turn = PositiveTurn(Azimuth(points, i)) / kTurn_rad;
    seen[std::min<std::size_t>(35, static_cast<std::size_t>(turn * 36.0))] = true;
  }
  return static_cast<double>(std::count(seen.begin(), seen.end(), true)) / 36.0;
}

}  // namespace lio
