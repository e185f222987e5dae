// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Takes the yaw in world of a body that turned unmeasured out of the filter. No sensor ever tells
// it once the old map is out of sight, and an extended Kalman filter in which it is unsure by a
// radian becomes sure of it by mere linearisation, so that its variance has to stand beside the
// filter.
#pragma once

#include "lio/filter/nav_state.hpp"

namespace lio {

// Returns the variance of the rotation about world's vertical, rad^2, and takes it out of the
// estimate: the covariance that is left is the one given the yaw.
[[nodiscard]] double TakeOutYaw(Estimate& estimate);

}  // namespace lio
