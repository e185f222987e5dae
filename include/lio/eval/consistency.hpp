// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Judges whether the covariance is consistent with the errors: NEES and NIS of many runs are
// compared with their chi-square bands. "Per dof" means divided by the number of dimensions: 1 is
// consistent, above 1 over-confident, below 1 conservative.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lio/eval/banded_series.hpp"
#include "lio/eval/run_errors.hpp"

namespace lio {

struct RmsPair {
  double real = 0;
  double predicted = 0;
};

struct Consistency {
  std::vector<std::string> runs;
  std::vector<double> run_pose_average_per_dof;             // time average of each run's pose NEES
  std::vector<std::optional<TiltSample>> run_largest_tilt;  // absent where none can be judged
  BandedSeries pose, position, rotation;    // times are since the first row of each run
  std::array<SigmaShares, 6> sigma_shares;  // world x, y, z; body rotation x, y, z
  RmsPair horizontal_m, vertical_m, tilt_deg, yaw_deg;
  std::optional<BandedSeries> nis;
  std::optional<Whiteness> nis_whiteness;  // whiteness of the NIS about its mean
  std::vector<std::string> notes;
};

// At least one run is required. Instants of different runs are joined when their times since the
// runs' starts agree to half a median interval.
[[nodiscard]] Consistency JudgeConsistency(const std::vector<RunErrors>& runs);

}  // namespace lio
