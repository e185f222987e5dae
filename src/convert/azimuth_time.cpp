// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/convert/azimuth_time.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "azimuth_order.hpp"
#include "lio/base/angle.hpp"
#include "lio/base/median.hpp"

namespace lio {
namespace {

// The front follows the points slowly, so that outliers do not carry it away.
constexpr double kFrontGain = 0.02;
constexpr double kMaxFrontStep = 1.0 * kRadPerDeg;
// First and last point are accepted when they are near the median of their neighbours.
constexpr std::size_t kMaxNeighbours = 64;
constexpr double kNearNeighbours = 2.0 * kRadPerDeg;

std::size_t NumNeighbours(std::size_t num_points) {
  return std::min(std::clamp<std::size_t>(num_points / 400, 5, kMaxNeighbours), num_points);
}

double HeadAzimuth(const SpinModel& model, const CloudPoints& points,
                   std::span<const std::uint16_t> rings, std::size_t i) {
  const double azimuth = std::atan2(points.y_m[i], points.x_m[i]);
  const bool has_offset = !rings.empty() && rings[i] < model.ring_offset_rad.size();
  return has_offset ? azimuth - model.ring_offset_rad[rings[i]] : azimuth;
}

// Returns the median of the wrapped differences to `value`, or 0 when `value` itself is near it.
double StrayCorrection(std::vector<double> differences) {
  const double median = UpperMedian(std::move(differences));
  return std::abs(median) > kNearNeighbours ? median : 0.0;
}

// Follows the front of one ring, or of all rings together, through the angles seen so far.
class Front {
 public:
  explicit Front(double at_rad) : at_rad_(at_rad) {}
  // Returns the angle that equals `angle` up to whole turns and is nearest to the front.
  double Unwrap(double angle) {
    const double ahead = PositiveTurn(angle - at_rad_ + kBackwardSlack) - kBackwardSlack;
    const double unwrapped = at_rad_ + ahead;
    at_rad_ += std::clamp(kFrontGain * ahead, -kMaxFrontStep, kMaxFrontStep);
    return unwrapped;
  }

 private:
  double at_rad_;
};

UnwrappedSweep UnwrapFirings(const SpinModel& model, const CloudPoints& points,
                             std::span<const std::uint16_t> rings) {
  UnwrappedSweep sweep;
  const std::size_t n = points.size();
  std::vector<double> azimuth(n);
  for (std::size_t i = 0; i < n; ++i) azimuth[i] = HeadAzimuth(model, points, rings, i);
  std::vector<double> differences;
  for (std::size_t i = 0; i < NumNeighbours(n); ++i) {
    differences.push_back(WrappedAngle(azimuth[i] - azimuth[0]));
  }
  sweep.first_azimuth_rad = azimuth[0] + StrayCorrection(std::move(differences));
  Front front(0.0);
  sweep.turned_rad.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    sweep.turned_rad[i] = front.Unwrap(model.direction * (azimuth[i] - sweep.first_azimuth_rad));
  }
  differences.clear();
  for (std::size_t i = n - NumNeighbours(n); i < n; ++i) {
    differences.push_back(sweep.turned_rad[i] - sweep.turned_rad.back());
  }
  sweep.last_turned_rad = sweep.turned_rad.back() + StrayCorrection(std::move(differences));
  return sweep;
}

UnwrappedSweep UnwrapRings(const SpinModel& model, const CloudPoints& points,
                           std::span<const std::uint16_t> rings) {
  const std::size_t n = points.size();
  const std::size_t num_rings = std::size_t{*std::max_element(rings.begin(), rings.end())} + 1;
  std::vector<std::optional<double>> first(num_rings);  // azimuth of each ring's first point
  for (std::size_t i = 0; i < n; ++i) {
    if (!first[rings[i]]) first[rings[i]] = HeadAzimuth(model, points, rings, i);
  }
  // Rings start together, but returns may be missing: the median start is robust against them.
  std::vector<double> differences;
  const double any = HeadAzimuth(model, points, rings, 0);
  for (const auto& azimuth : first) {
    if (azimuth) differences.push_back(WrappedAngle(*azimuth - any));
  }
  UnwrappedSweep sweep;
  sweep.first_azimuth_rad = any + UpperMedian(std::move(differences));
  std::vector<Front> fronts(num_rings, Front(0.0));
  std::vector<double> last(num_rings, 0.0);
  sweep.turned_rad.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double azimuth = HeadAzimuth(model, points, rings, i);
    sweep.turned_rad[i] =
        fronts[rings[i]].Unwrap(model.direction * (azimuth - sweep.first_azimuth_rad));
    last[rings[i]] = sweep.turned_rad[i];
  }
  std::erase(last, 0.0);
  sweep.last_turned_rad = UpperMedian(std::move(last));
  return sweep;
}

UnwrappedSweep UnwrapUnordered(const SpinModel& model, const CloudPoints& points,
                               std::span<const std::uint16_t> rings) {
  UnwrappedSweep sweep;
  sweep.first_azimuth_rad = std::numbers::pi;
  sweep.turned_rad.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double azimuth = HeadAzimuth(model, points, rings, i);
    sweep.turned_rad[i] = PositiveTurn(model.direction * (azimuth - sweep.first_azimuth_rad));
  }
  sweep.last_turned_rad = kTurn_rad;
  return sweep;
}

}  // namespace

UnwrappedSweep UnwrapAzimuth(const SpinModel& model, const CloudPoints& points,
                             std::span<const std::uint16_t> rings) {
  if (points.size() == 0) return {};
  if (model.order == PointOrder::kFiring) return UnwrapFirings(model, points, rings);
  if (model.order == PointOrder::kByRing && !rings.empty()) {
    return UnwrapRings(model, points, rings);
  }
  return UnwrapUnordered(model, points, rings);
}

double TurnBetween(double first_azimuth_rad, double next_first_azimuth_rad, double covered_rad,
                   double direction) {
  const double turned = direction * (next_first_azimuth_rad - first_azimuth_rad);
  return covered_rad + WrappedAngle(turned - covered_rad);
}

void SpinRate::Add(Timestamp stamp, const UnwrappedSweep& sweep, double direction) {
  if (last_stamp_) {
    const double turned =
        TurnBetween(last_azimuth_rad_, sweep.first_azimuth_rad, last_turned_rad_, direction);
    const double seconds = SecondsBetween(*last_stamp_, stamp);
    constexpr double kMaxDeviation = 0.2;
    if (seconds > 0.0 && std::abs(turned / seconds / radps_ - 1.0) < kMaxDeviation) {
      constexpr double kForget = 0.98;  // a time constant of about five seconds at 10 Hz
      turned_rad_ = kForget * turned_rad_ + turned;
      seconds_ = kForget * seconds_ + seconds;
      radps_ = turned_rad_ / seconds_;
    }
  }
  last_stamp_ = stamp;
  last_azimuth_rad_ = sweep.first_azimuth_rad;
  last_turned_rad_ = sweep.last_turned_rad;
}

std::vector<std::int64_t> AzimuthInstants(const UnwrappedSweep& sweep, double rate_radps,
                                          Timestamp stamp, bool stamp_is_end) {
  const double zero = stamp_is_end ? sweep.last_turned_rad : 0.0;
  std::vector<std::int64_t> instants(sweep.turned_rad.size());
  std::transform(sweep.turned_rad.begin(), sweep.turned_rad.end(), instants.begin(),
                 [&](double turned) {
                   const double seconds = (turned - zero) / rate_radps;
                   return (stamp + Duration::FromSeconds(seconds)).ns;
                 });
  return instants;
}

}  // namespace lio
