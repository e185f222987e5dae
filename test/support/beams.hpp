// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Errors of two beams, as the rig lists them and as the calibration has them.
#pragma once

#include "lio/sensor/beam_errors.hpp"
#include "lio/sensor/rig.hpp"

namespace lio::test {

inline LidarBeams TwoLidarBeams() {
  return {.range_m = {0.012, -0.003},
          .range_std_m = {0.004, 0.005},
          .elevation_rad = {1e-8, -2e-4},
          .elevation_std_rad = {1e-4, 2e-4},
          .azimuth_rad = {0.0, 3e-4},
          .azimuth_std_rad = {3e-4, 4e-4},
          .encoder_rad = {1e-4, -5e-5},
          .encoder_std_rad = {4e-5, 5e-5}};
}

inline BeamKnowledge TwoKnownBeams() {
  BeamKnowledge known;
  known.errors.rings = {{0.012f, 1e-4f, -2e-4f}, {-0.02f, 0.f, 3e-4f}};
  known.errors.encoder_rad = {1e-4f, -5e-5f};
  known.std.rings = {{0.003f, 1e-4f, 2e-4f}, {0.004f, 2e-4f, 3e-4f}};
  known.std.encoder_rad = {3e-5f, 4e-5f};
  return known;
}

}  // namespace lio::test
