// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Point times of a spinning lidar rebuilt from azimuth, for drivers that write none. The head turns
// evenly, so a point's time is the angle the head has turned since the first point, over its rate.
// Angles are unwrapped in the order of the points, ring by ring where the source stores rings one
// after another, so that a sweep may overlap itself at the seam. Direction, order, rate and each
// ring's azimuth offset are measured on the recording.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lio/base/time.hpp"
#include "lio/convert/pointcloud2_layout.hpp"

namespace lio {

enum class PointOrder {
  kFiring,  // as fired: all rings turn together
  kByRing,  // one ring after the other, each in time
  kNone,    // neither: only the azimuth itself is left, cut behind the sensor
};

struct SpinModel {
  double direction = -1.0;  // +1 counter-clockwise seen from above, -1 clockwise
  PointOrder order = PointOrder::kFiring;
  std::vector<double> ring_offset_rad;  // azimuth of each ring against the head's; may be empty
  double rate_radps = 0.0;              // > 0
  std::string description;              // for people
};

// Angles that the head has turned at each point since the first one [rad], and what connects
// sweeps to each other.
struct UnwrappedSweep {
  std::vector<double> turned_rad;
  double first_azimuth_rad = 0.0;  // of the head at the first point
  double last_turned_rad = 0.0;    // at the last point
};

// `rings` is empty or has one ring per point.
UnwrappedSweep UnwrapAzimuth(const SpinModel& model, const CloudPoints& points,
                             std::span<const std::uint16_t> rings);

// The head's rate from the stamps and first azimuths of successive sweeps, forgetting slowly.
class SpinRate {
 public:
  // `radps`: what the rate is near to; sweeps that say otherwise (a sweep was lost) are left out.
  explicit SpinRate(double radps) : radps_(radps) {}
  void Add(Timestamp stamp, const UnwrappedSweep& sweep, double direction);
  double radps() const { return radps_; }

 private:
  double radps_;
  double turned_rad_ = 0.0;
  double seconds_ = 0.0;
  std::optional<Timestamp> last_stamp_;
  double last_azimuth_rad_ = 0.0;
  double last_turned_rad_ = 0.0;
};

// Angle from the first point of a sweep to the first point of the next [rad]: the turn that is
// nearest to what the sweep itself covers.
double TurnBetween(double first_azimuth_rad, double next_first_azimuth_rad, double covered_rad,
                   double direction);

// Instants of the points [ns]: the stamp is that of the first point, or of the last one.
std::vector<std::int64_t> AzimuthInstants(const UnwrappedSweep& sweep, double rate_radps,
                                          Timestamp stamp, bool stamp_is_end);

}  // namespace lio
