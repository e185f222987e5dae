// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Tells how far a map has bent since it began, as gravity shows. Errors that move with the sensor
// (biases of lasers, errors of the beam table) tilt a growing map little by little: 3 mrad in
// 400 m, and a path of which height and scale follow. The accelerometer is off by as much, but by
// the same all the time. The filter therefore remembers the rotation between world and map of the
// map's start, with its error, as a state; what the present rotation differs by is the bend, and
// the tilt that the start already had is none. A scan that is inserted level, with the bend taken
// back, makes the map grow straight. Figures: docs/experiments/map_level.md.
#pragma once

#include "lio/filter/nav_state.hpp"

namespace lio {

// Remembers the estimate's rotation between world and map as that of the map's start.
void MarkMapStart(Estimate& estimate);

// Returns the tilt by which the map at the body's place has bent since its start: a rotation
// vector, rad, along world's axes, without the part about the vertical, which gravity does not
// show.
[[nodiscard]] Vector3 MapBend(const NavState& state);

// Returns T_map_imu turned about the imu so that `share` of the bend is taken back.
[[nodiscard]] Pose LevelMapPose(const NavState& state, double share);

}  // namespace lio
