// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Rebuilds the point times of a spinning lidar from azimuth, for drivers that write none. The head
// turns evenly, so a point's time is the angle the head has turned since the first point, divided
// by its rate. Angles are unwrapped in the order of the points (ring by ring if the source stores
// rings one after another), so that a sweep may overlap itself at the seam. Direction, order, rate
// and each ring's azimuth offset are measured on the recording.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lio/base/time.hpp"
#include "lio/convert/pointcloud2_layout.hpp"

namespace lio {

enum class PointOrder {
  kFiring,  // in the order of firing: all rings turn together
  kByRing,  // one ring after the other, each in the order of time
  kNone,    // neither: the azimuth alone is used, cut behind the sensor
};

struct SpinModel {
  double direction = -1.0;  // seen from above: +1 counter-clockwise, -1 clockwise
  PointOrder order = PointOrder::kFiring;
  std::vector<double> ring_offset_rad;  // azimuth of each ring relative to the head's; may be empty
  double rate_radps = 0.0;              // > 0
  std::string description;              // shown to the user
};

// Holds the angles that the head has turned at each point since the first one [rad], and the values
// that connect one sweep with the next.
struct UnwrappedSweep {
  std::vector<double> turned_rad;
  double first_azimuth_rad = 0.0;  // azimuth of the head at the first point
  double last_turned_rad = 0.0;    // turned angle at the last point
};

// `rings` is empty or has one ring per point.
[[nodiscard]] UnwrappedSweep UnwrapAzimuth(const SpinModel& model, const CloudPoints& points,
                                           std::span<const std::uint16_t> rings);

// Estimates the head's rate from the stamps and first azimuths of successive sweeps, with slowly
// fading memory.
class SpinRate {
 public:
  // `radps` is the approximate rate; sweeps that contradict it (because a sweep was lost) are left
  // out.
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

// Returns the angle from the first point of a sweep to the first point of the next [rad]: of the
// angles that differ by whole turns, the nearest to the angle that the sweep itself covers.
[[nodiscard]] double TurnBetween(double first_azimuth_rad, double next_first_azimuth_rad,
                                 double covered_rad, double direction);

// Returns the instants of the points [ns]; the stamp is that of the first or of the last point.
[[nodiscard]] std::vector<std::int64_t> AzimuthInstants(const UnwrappedSweep& sweep,
                                                        double rate_radps, Timestamp stamp,
                                                        bool stamp_is_end);

}  // namespace lio
