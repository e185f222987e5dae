// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Changes from one map to another in which the body was found.
#pragma once

#include "lio/filter/nav_state.hpp"

namespace lio {

// T_map_imu becomes the pose in the map `to`, which differs from the one so far by `T_to_map`. The
// world moves along, level as it is: its position and its yaw become those of the new map, so that
// both frames agree where that map is level. `cov` is that of the body's pose in the new map, right
// error.
void ChangeMap(const Pose& T_to_map, const Matrix6& cov, Estimate& estimate);

}  // namespace lio
