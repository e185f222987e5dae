// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Reads rotations and transforms in the forms that calibration tools print beside quaternions. As
// in yaml_values.hpp, an empty text means that the value was taken; otherwise it says what is
// wrong.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "lio/base/pose.hpp"

namespace lio {

// Takes [roll, pitch, yaw] in degrees about the fixed axes x, y, z in this order, as URDF and
// tf have it: R = Rz(yaw) Ry(pitch) Rx(roll).
[[nodiscard]] std::string ParseRpyDeg(const YAML::Node& node, Quaternion& rotation);

// Takes three rows of three numbers, or nine numbers row by row. A matrix that is off from a
// rotation by rounding becomes the nearest rotation; one that is farther off is refused.
[[nodiscard]] std::string ParseRotationMatrix(const YAML::Node& node, Quaternion& rotation);

// Takes four rows of four numbers, or sixteen numbers row by row: rotation, translation [m], and
// the row 0 0 0 1.
[[nodiscard]] std::string ParseTransformMatrix(const YAML::Node& node, Pose& pose);

}  // namespace lio
