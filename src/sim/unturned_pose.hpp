// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Places a solid of a mesh without turning it, the shortest way to say where. It is used inside
// src/sim only.
#pragma once

#include "lio/base/pose.hpp"

namespace lio::sim {

[[nodiscard]] inline Pose At(double x_m, double y_m, double z_m) {
  return {Quaternion::Identity(), {x_m, y_m, z_m}};
}

}  // namespace lio::sim
