// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Describes what a lidar's data sheet and beam table do not tell of it: every laser measures a
// range and points to an elevation that are a little off, and the encoder's azimuth is off by a
// sine once a turn (an eccentric disc). They move with the sensor, so neither points nor scans
// average them away. All are in the lidar frame, whose z axis is the axis of rotation, and all are
// measured minus true.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace lio {

// Rings beyond are not calibrated: no lidar on the market has more beams, and a false ring number
// cannot make the calibration dearer than this.
inline constexpr std::uint16_t kMaxCalibratedRings = 128;

struct BeamErrors {
  struct OfRing {
    float range_m = 0.f;
    float elevation_rad = 0.f;
    float azimuth_rad = 0.f;
  };
  std::vector<OfRing> rings;                              // 0 is the lowest; others have no error
  Eigen::Vector2f encoder_rad = Eigen::Vector2f::Zero();  // times (cos, sin) of the azimuth
};

// The errors of one lidar's beams and their standard deviations, as found on a drive.
struct BeamKnowledge {
  BeamErrors errors;
  BeamErrors std;  // as many rings as in errors; rings beyond are not known
};

// Tells by how much a point moves (m) for a unit of each error.
struct BeamAxes {
  Eigen::Vector3f range;      // a metre of range, along the beam
  Eigen::Vector3f elevation;  // a radian of elevation, upwards
  Eigen::Vector3f azimuth;    // a radian of azimuth, counter-clockwise from above
  float cos_azimuth = 1.f;
  float sin_azimuth = 0.f;
};

// `position`: in the lidar frame at its own instant, m. One on the axis of rotation has no azimuth,
// and 0 is taken.
[[nodiscard]] inline BeamAxes AxesOf(const Eigen::Vector3f& position) {
  const float level_m = std::sqrt(position.x() * position.x() + position.y() * position.y());
  BeamAxes axes;
  if (level_m > 0.f) {
    axes.cos_azimuth = position.x() / level_m;
    axes.sin_azimuth = position.y() / level_m;
  }
  axes.range = position / std::max(position.norm(), 1e-6f);
  axes.elevation = {-position.z() * axes.cos_azimuth, -position.z() * axes.sin_azimuth, level_m};
  axes.azimuth = {-position.y(), position.x(), 0.f};
  return axes;
}

[[nodiscard]] inline BeamAxes Turned(const BeamAxes& axes, const Eigen::Matrix3f& rotation) {
  return {rotation * axes.range, rotation * axes.elevation, rotation * axes.azimuth,
          axes.cos_azimuth, axes.sin_azimuth};
}

// Returns how far the point is off, m.
[[nodiscard]] inline Eigen::Vector3f Displacement(const BeamErrors& errors, std::uint16_t ring,
                                                  const BeamAxes& axes) {
  BeamErrors::OfRing of_ring;
  if (ring < errors.rings.size()) of_ring = errors.rings[ring];
  const float azimuth_rad = of_ring.azimuth_rad + errors.encoder_rad.x() * axes.cos_azimuth +
                            errors.encoder_rad.y() * axes.sin_azimuth;
  return of_ring.range_m * axes.range + of_ring.elevation_rad * axes.elevation +
         azimuth_rad * axes.azimuth;
}

}  // namespace lio
