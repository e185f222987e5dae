// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The least squares of a calibration: offset, rotation and gyro bias from the turns between sweeps,
// by Ceres with preintegrated rates (Forster et al., TRO 2017). docs/calibration.md has the
// residuals.
#pragma once

#include <span>
#include <vector>

#include "lio/calib/rotation_calibration.hpp"

namespace lio {

// The turn between sweeps `first` and `first` + 1; stamps by the lidar's clock, R_from_to in its
// axes.
struct SweepTurn {
  std::size_t first = 0;
  Timestamp from, to;
  Quaternion R_from_to = Quaternion::Identity();
};

// Fills all of `state` but correlation and turn_rate_rms_radps, from a guess within 20 ms and a few
// degrees. Returns false when it does not converge or the turns do not determine it.
[[nodiscard]] bool FitTurns(std::span<const ImuSample> samples, std::span<const SweepTurn> turns,
                            RotationCalibration& state);

}  // namespace lio
