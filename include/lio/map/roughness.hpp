// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tells how rough a plane of the map is, and how flat it was seen. On grass, clods or gravel a beam
// ends on the first blade or stone that it meets, so that the flatter it comes in, the higher the
// ground seems to be: by some half of the roughness each time the sine of the angle falls by a
// factor of e. (Smith, "Geometrical shadowing of a random rough surface", IEEE Trans. Antennas and
// Propagation 15(5), 1967, gives the share of a Gaussian surface that is seen.) A scan that comes
// nearer to ground that was mapped from afar sees it lower, what lies behind it higher, and pitches
// the map if that is not known (docs/experiments/rough_ground.md).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lio {

class Roughness {
 public:
  Roughness() = default;
  // `std_m`: of the points across the plane, without the noise of the ranges. `sine`: the mean over
  // the points of the cosine between beam and normal.
  Roughness(float std_m, float sine) : std_(Packed(std_m)), sine_(Packed(sine)) {}

  // True where the plane looks the same from everywhere.
  [[nodiscard]] bool is_smooth() const { return std_ == 0; }
  // Returns by how much a point seen at this sine stands out from the plane, in m per unit of the
  // share that the drive shows (BeamCalibration::relief()).
  [[nodiscard]] float HeightAt(float sine) const {
    const float mean_sine = std::max(static_cast<float>(sine_) / kOne, kMinSine);
    return static_cast<float>(std_) / kOne * std::log(mean_sine / std::clamp(sine, kMinSine, 1.f));
  }

 private:
  static constexpr float kOne = 65535.f;
  // Chosen: at 1 deg the tops of the ground hide all else.
  static constexpr float kMinSine = 0.02f;

  static std::uint16_t Packed(float value) {
    return static_cast<std::uint16_t>(kOne * std::clamp(value, 0.f, 1.f));
  }

  std::uint16_t std_ = 0;  // in 1 / kOne m
  std::uint16_t sine_ = 0;
};

}  // namespace lio
