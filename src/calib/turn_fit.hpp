// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The least squares of a calibration: offset, rotation and gyro bias from the turns between sweeps.
#pragma once

#include <span>
#include <vector>

#include "lio/calib/rotation_calibration.hpp"

namespace lio {

// Between sweeps `first` and `first` + 1; R_from_to in the lidar's axes.
struct SweepTurn {
  std::size_t first = 0;
  Timestamp from, to;
  Quaternion R_from_to = Quaternion::Identity();
};

// Fills everything of `state` but correlation and liveliness, from a guess within 20 ms and a few
// degrees. False when it does not converge or the turns do not determine it.
bool FitTurns(std::span<const ImuSample> samples, std::span<const SweepTurn> turns,
              RotationCalibration& state);

}  // namespace lio
