// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Remembers which beams the points of a plane came from, and what an error of each would do to the
// plane's mean: a point that lies off the plane differs from it by its own beam's error minus the
// mean of theirs (registration/beam_calibration.hpp).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "lio/sensor/beam_errors.hpp"

namespace lio {

// One point of a scan that is inserted, as its beam saw it. Vectors are in the map's frame.
struct SeenBeam {
  std::uint16_t ring = 0;
  BeamAxes axes;
  Eigen::Vector3f correction_m = Eigen::Vector3f::Zero();  // was taken off the point
};

// Those of a scan; none where beams are not known. One point in kSampling has a beam, from the
// first on. Chosen: a third is enough for means, and the columns of 16, 32 and 64 beams are no
// multiples of three.
struct SeenBeams {
  static constexpr std::size_t kSampling = 3;
  std::span<const SeenBeam> beams = {};
  float path_m = 0.f;  // the vehicle's way up to here
};

// A point moves so far along a plane's normal (m) for a unit of each error of its beam.
struct BeamShift {
  float range = 0.f;
  float elevation = 0.f;
  float azimuth = 0.f;
};

[[nodiscard]] inline BeamShift ShiftAlong(const Eigen::Vector3f& normal, const BeamAxes& axes) {
  return {normal.dot(axes.range), normal.dot(axes.elevation), normal.dot(axes.azimuth)};
}

// A range is longer than at right angles by so much, along the normal, per metre of the effect:
// the beam's spot is an ellipse, 1 / |cosine| long. Chosen: at most that of 82 deg.
[[nodiscard]] inline float GrazingShift(float cosine) {
  constexpr float kMaxGrazing = 6.7f;
  return cosine * std::min(1.f / std::max(std::abs(cosine), 1e-3f) - 1.f, kMaxGrazing);
}

struct CellBeams {
  static constexpr std::size_t kMaxRings = 6;

  // Points of a ring, or of neighbouring ones, where there are more than kMaxRings.
  struct OfRing {
    BeamShift shift;              // mean
    std::uint8_t ring = 0;        // the one with most points
    std::uint8_t num_points = 0;  // in proportion; 0: not used
  };

  // Adds a point on the plane of this normal.
  void Add(const SeenBeam& beam, const Eigen::Vector3f& normal, float scan_path_m);

  // These are means over the points.
  float path_m = 0.f;
  float cos_azimuth = 0.f;  // a shift by the azimuth, times its (cos, sin)
  float sin_azimuth = 0.f;
  float grazing = 0.f;
  float correction_m = 0.f;  // along the normal
  std::uint32_t num_points = 0;
  std::array<OfRing, kMaxRings> rings;  // used ones first, by ring

 private:
  void AddToRing(std::uint8_t ring, const BeamShift& shift);
  void MergeNearest();
};

}  // namespace lio
