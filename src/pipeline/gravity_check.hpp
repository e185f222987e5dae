// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Does the force that an IMU feels contradict a motion that it had no part in? Over a short time
// its integral is the change of the velocity less gravity's, in the axes of an attitude that may be
// turned over.
#pragma once

#include <span>

#include "lio/filter/nav_state.hpp"
#include "lio/filter/preintegration.hpp"

namespace lio {

struct GravityCheckParameters {
  // Chosen: two steps of a walk average out, and a velocity that errs by 0.5 m/s counts for little.
  double window_s = 1.0;
  // The mean force may be off by this share of gravity, ... chosen: 0.4 rad of tilt; an attitude
  // that scans have led so far astray is of no use.
  double max_off_ratio = 0.4;
  // ... and by so many standard deviations of the change of the velocity. Statistics: 99.7 %.
  double sigmas = 3.0;
};

inline constexpr GravityCheckParameters kGravityCheck;

// `from` and `to` are estimates of that motion, in a level world; `samples` cover the time between
// them. False without samples.
[[nodiscard]] bool GravityContradicts(std::span<const ImuSample> samples, const Estimate& from,
                                      const Estimate& to, const Vector3& g_world,
                                      const Biases& biases);

}  // namespace lio
