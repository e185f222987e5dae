// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Defines units of angles: radians inside, degrees where people read and write them.
#pragma once

#include <numbers>

namespace lio {

inline constexpr double kRadPerDeg = std::numbers::pi / 180.0;
inline constexpr double kDegPerRad = 180.0 / std::numbers::pi;
inline constexpr double kTurn_rad = 2.0 * std::numbers::pi;

}  // namespace lio
