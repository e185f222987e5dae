// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Is the covariance honest? NEES and NIS of many runs against their chi-square bands. "Per dof"
// means divided by the number of dimensions: 1 is honest, above 1 over-confident, below 1 timid.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lio/eval/chi_square.hpp"
#include "lio/eval/run_errors.hpp"

namespace lio {

// The mean over the runs at each instant, and the 95 % band in which it belongs.
struct BandedSeries {
  int dof = 0;
  std::vector<double> time_s;  // since the first row of each run
  std::vector<double> mean_per_dof;
  std::vector<Band> band_per_dof;  // of that many runs
  double average_per_dof = 0;      // over all instants of all runs: ANEES (ANIS) / dof
  double end_average_per_dof = 0;  // over the last tenth of the time
  double share_in_band = 0;        // of the instants, 0..1
};

// Shares of |error| inside 1, 2, 3 sigma; Gaussian: 0.683, 0.954, 0.997.
using SigmaShares = std::array<double, 3>;

struct RmsPair {
  double real = 0;
  double predicted = 0;
};

// Autocorrelation of the NIS about its mean, averaged over runs: white innovations stay within
// +-1.96 / sqrt(N), N the number of products.
struct Whiteness {
  std::vector<double> autocorrelation;  // of lag 1, 2, ...
  std::vector<double> band;             // half width, a lag
  double share_in_band = 0;
};

struct Consistency {
  std::vector<std::string> runs;
  std::vector<double> run_pose_average_per_dof;  // NEES of each run's pose, over its time
  BandedSeries pose, position, rotation;
  std::array<SigmaShares, 6> sigma_shares;  // world x, y, z; body rotation x, y, z
  RmsPair horizontal_m, vertical_m, tilt_deg, yaw_deg;
  std::optional<BandedSeries> nis;
  std::optional<Whiteness> nis_whiteness;
  std::vector<std::string> notes;
};

// At least one run. Instants of different runs meet when they are as far from their runs' starts,
// to half a median interval.
Consistency JudgeConsistency(const std::vector<RunErrors>& runs);

}  // namespace lio
